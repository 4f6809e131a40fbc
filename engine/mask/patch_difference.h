#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace weft {

constexpr int kPatchRadius = 2;  // 5×5 pixels
constexpr int kPatchValues = 3 * (2 * kPatchRadius + 1) * (2 * kPatchRadius + 1);

/// Sum of absolute differences of the 15 values of one row of a patch.
[[nodiscard]] inline int row_difference(const std::uint8_t* a, const std::uint8_t* b) {
    static_assert(kPatchValues == 5 * 15);
#ifdef __SSE2__
    // Two halves of 8 values, without reading beyond the 15; the one that both hold counts once.
    const auto values = [](const std::uint8_t* p) {
        const auto* first = reinterpret_cast<const __m128i*>(p);
        const auto* second = reinterpret_cast<const __m128i*>(p + 7);
        const __m128i twice = _mm_slli_epi64(_mm_srli_epi64(_mm_loadl_epi64(second), 8), 8);
        return _mm_unpacklo_epi64(_mm_loadl_epi64(first), twice);
    };
    const __m128i halves = _mm_sad_epu8(values(a), values(b));
    return _mm_cvtsi128_si32(halves) + _mm_cvtsi128_si32(_mm_srli_si128(halves, 8));
#else
    int sum = 0;
    for (int i = 0; i < 15; ++i)
        sum += std::abs(a[i] - b[i]);
    return sum;
#endif
}

/// Sum of absolute differences of two 8-bit RGB patches around the pixels `a` and `b`, which lie at
/// least kPatchRadius from the border. Stops early once it is not below `best`. Strides in
/// elements.
[[nodiscard]] inline int patch_difference(const std::uint8_t* a, std::ptrdiff_t a_stride,
                                          const std::uint8_t* b, std::ptrdiff_t b_stride,
                                          int best) {
    int sum = 0;
    for (int v = -kPatchRadius; v <= kPatchRadius && sum < best; ++v) {
        const std::uint8_t* p = a + v * a_stride - 3 * kPatchRadius;
        const std::uint8_t* q = b + v * b_stride - 3 * kPatchRadius;
        sum += row_difference(p, q);
    }
    return sum;
}

}  // namespace weft
