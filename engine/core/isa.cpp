#include "engine/core/isa.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <utility>

namespace weft {
namespace {

constexpr std::array<std::pair<Isa, std::string_view>, 3> kNames{
    {{Isa::kScalar, "scalar"}, {Isa::kAvx2, "avx2"}, {Isa::kAvx512, "avx512"}}};

Isa best_isa() {
    if (isa_available(Isa::kAvx512)) return Isa::kAvx512;
    return isa_available(Isa::kAvx2) ? Isa::kAvx2 : Isa::kScalar;
}

Isa initial_isa() {
    const char* name = std::getenv("WEFT_ISA");
    const auto wanted = name ? parse_isa(name) : std::nullopt;
    return wanted && isa_available(*wanted) ? *wanted : best_isa();
}

std::atomic<int> forced{-1};

}  // namespace

bool isa_available(Isa isa) {
#if defined(__x86_64__)
    switch (isa) {
        case Isa::kAvx2:
            return __builtin_cpu_supports("avx2");
        case Isa::kAvx512:
            return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vnni");
        default:
            return true;
    }
#else
    return isa == Isa::kScalar;
#endif
}

Isa current_isa() {
    static const Isa initial = initial_isa();
    const int isa = forced.load(std::memory_order_relaxed);
    return isa < 0 ? initial : static_cast<Isa>(isa);
}

void force_isa(std::optional<Isa> isa) {
    forced = isa && isa_available(*isa) ? static_cast<int>(*isa) : -1;
}

std::optional<Isa> parse_isa(std::string_view name) {
    for (const auto& [isa, known] : kNames) {
        if (known == name) return isa;
    }
    return std::nullopt;
}

std::string_view isa_name(Isa isa) {
    return kNames[static_cast<std::size_t>(isa)].second;
}

}  // namespace weft
