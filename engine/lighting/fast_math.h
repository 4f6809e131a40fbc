#pragma once
// Natural logarithm and exponential without the C library, whose variants for different processors
// may differ in the last bit. Relative error below 2e-7, which is far under what light needs.

#include <algorithm>
#include <bit>
#include <cstdint>

namespace weft {

/// ln(x) for finite x > 0 that is not subnormal.
inline float fast_log(float x) {
    // x = 2^e · m with m in [√½, √2); ln m = 2 artanh((m − 1) / (m + 1)).
    constexpr std::int32_t kSqrtHalf = 0x3f3504f3;
    const std::int32_t bits = std::bit_cast<std::int32_t>(x) - kSqrtHalf;
    const float exponent = static_cast<float>(bits >> 23);
    const float m = std::bit_cast<float>((bits & 0x007fffff) + kSqrtHalf);
    const float t = (m - 1.0f) / (m + 1.0f);
    const float t2 = t * t;
    const float series =
        2.0f + t2 * (0.66666667f + t2 * (0.4f + t2 * (0.28571429f + t2 * 0.22222222f)));
    return exponent * 0.69314718f + t * series;
}

/// e^x, with x held within [−80, 80].
inline float fast_exp(float x) {
    x = std::min(std::max(x, -80.0f), 80.0f);
    const float scaled = x * 1.44269504f + (x < 0 ? -0.5f : 0.5f);
    const std::int32_t n = static_cast<std::int32_t>(scaled);
    const float nf = static_cast<float>(n);
    const float r = (x - nf * 0.693145752f) - nf * 1.42860677e-6f;
    const float p =
        1.0f +
        r * (1.0f + r * (0.5f + r * (0.16666667f + r * (0.041666667f +
                                                        r * (0.0083333333f + r * 0.0013888889f)))));
    return p * std::bit_cast<float>((n + 127) << 23);
}

}  // namespace weft
