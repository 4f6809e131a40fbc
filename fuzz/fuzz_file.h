#pragma once
// Writes bytes to a file, for readers that need a name.
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

// The quarantine of freed memory finds late uses. At its default of 256 MB, large pictures would
// exceed libFuzzer's limit without any fault.
extern "C" inline const char* __asan_default_options() {
    return "quarantine_size_mb=16";
}

namespace weft::fuzz {

/// Always the same name, so that files do not accumulate; private to the process.
inline std::string put_file(const std::uint8_t* data, std::size_t size, const char* extension) {
    static const std::string stem = [] {
        const char* folder = std::getenv("TMPDIR");
        return std::string(folder ? folder : "/tmp") + "/weft_fuzz_" + std::to_string(getpid());
    }();
    const std::string path = stem + extension;
    if (std::FILE* file = std::fopen(path.c_str(), "wb")) {
        std::fwrite(data, 1, size, file);
        std::fclose(file);
    }
    return path;
}

}  // namespace weft::fuzz
