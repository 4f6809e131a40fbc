// Part of the program only when the engine is built for more than any x86-64 (WEFT_CPU): says so on
// an older machine, before the first instruction that it does not know.

#include <unistd.h>

#include <cstdlib>

#include "engine/core/error.h"

namespace {

constexpr char kTooOld[] =
    "weft: This build needs a processor with AVX2, BMI2 and FMA (x86-64-v3), and this one is "
    "older. "
    "Build Weft on this machine with ./run, or with -DWEFT_CPU= for any processor.\n";

// Before all other constructors, with system calls only: functions of the standard library may be
// the engine's copies, compiled for the newer processor.
__attribute__((constructor(101))) void check_processor() {
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") &&
        __builtin_cpu_supports("fma"))
        return;
    if (write(STDERR_FILENO, kTooOld, sizeof kTooOld - 1) < 0) _exit(1);
    _exit(static_cast<int>(weft::ErrorCode::kNoBackend));
}

}  // namespace
