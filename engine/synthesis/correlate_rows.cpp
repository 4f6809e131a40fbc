#include "engine/synthesis/correlate_rows.h"

#include <algorithm>
#include <array>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace weft {
namespace {

// A lane of 32 bits gains at most 4 · 128 · 255 a step (AVX-512) or 2 · 128 · 255 (AVX2).
constexpr int kStepsUntilFull = 16000;

using Rows = std::vector<CorrelationRow>;

void correlate_scalar(const Rows& rows, const std::int16_t* a, std::size_t stride,
                      const std::uint8_t* b, int count, std::int64_t* out) {
    for (int k = 0; k < count; ++k) {
        std::int64_t sum = 0;
        for (const CorrelationRow& r : rows) {
            const std::int16_t* pa = a + r.a + static_cast<std::size_t>(k) * stride;
            const std::uint8_t* pb = b + r.b;
            for (int chunk = 0; chunk < r.chunks; ++chunk) {
                std::int32_t part = 0;
                for (int i = 0; i < kCorrelationChunk; ++i)
                    part += pa[i] * static_cast<std::int16_t>(pb[i]);
                sum += part;
                pa += kCorrelationChunk, pb += kCorrelationChunk;
            }
        }
        out[k] = sum;
    }
}

#if defined(__x86_64__)

// One chunk of b stays in a register while `N` rows of a, which are aligned, are read.
template <int N>
[[gnu::target("avx512f,avx512bw,avx512vl,avx512vnni")]] void group_avx512(const Rows& rows,
                                                                          const std::int8_t* a,
                                                                          std::size_t stride,
                                                                          const std::uint8_t* b,
                                                                          std::int64_t* out) {
    __m512i sums[N];
    for (int k = 0; k < N; ++k)
        sums[k] = _mm512_setzero_si512();
    std::fill_n(out, N, 0);
    int steps = 0;
    for (std::size_t r = 0; r <= rows.size(); ++r) {
        const int chunks = r < rows.size() ? rows[r].chunks : 0;
        if (r == rows.size() || steps + chunks > kStepsUntilFull) {
            for (int k = 0; k < N; ++k) {
                alignas(64) std::array<std::int32_t, 16> lanes;
                _mm512_store_si512(lanes.data(), sums[k]);
                for (const std::int32_t lane : lanes)
                    out[k] += lane;
                sums[k] = _mm512_setzero_si512();
            }
            steps = 0;
        }
        for (int i = 0; i < chunks; ++i) {
            const std::size_t at = static_cast<std::size_t>(i) * kCorrelationChunk;
            const __m512i vb = _mm512_loadu_si512(b + rows[r].b + at);
            const std::int8_t* pa = a + rows[r].a + at;
            for (int k = 0; k < N; ++k) {
                const auto shift = static_cast<std::size_t>(k) * stride;
                sums[k] = _mm512_dpbusd_epi32(sums[k], vb, _mm512_load_si512(pa + shift));
            }
        }
        steps += chunks;
    }
}

template <int N>
[[gnu::target("avx2")]] void group_avx2(const Rows& rows, const std::int16_t* a, std::size_t stride,
                                        const std::uint8_t* b, std::int64_t* out) {
    __m256i sums[N];
    for (int k = 0; k < N; ++k)
        sums[k] = _mm256_setzero_si256();
    std::fill_n(out, N, 0);
    int steps = 0;
    for (std::size_t r = 0; r <= rows.size(); ++r) {
        const int parts = r < rows.size() ? rows[r].chunks * (kCorrelationChunk / 16) : 0;
        if (r == rows.size() || steps + parts > kStepsUntilFull) {
            for (int k = 0; k < N; ++k) {
                alignas(32) std::array<std::int32_t, 8> lanes;
                _mm256_store_si256(reinterpret_cast<__m256i*>(lanes.data()), sums[k]);
                for (const std::int32_t lane : lanes)
                    out[k] += lane;
                sums[k] = _mm256_setzero_si256();
            }
            steps = 0;
        }
        for (int i = 0; i < parts; ++i) {
            const std::size_t at = static_cast<std::size_t>(i) * 16;
            const __m256i vb = _mm256_cvtepu8_epi16(
                _mm_loadu_si128(reinterpret_cast<const __m128i*>(b + rows[r].b + at)));
            const std::int16_t* pa = a + rows[r].a + at;
            for (int k = 0; k < N; ++k) {
                const auto* va =
                    reinterpret_cast<const __m256i*>(pa + static_cast<std::size_t>(k) * stride);
                sums[k] = _mm256_add_epi32(sums[k], _mm256_madd_epi16(vb, _mm256_load_si256(va)));
            }
        }
        steps += parts;
    }
}

using Avx512Fn = void (*)(const Rows&, const std::int8_t*, std::size_t, const std::uint8_t*,
                          std::int64_t*);
using Avx2Fn = void (*)(const Rows&, const std::int16_t*, std::size_t, const std::uint8_t*,
                        std::int64_t*);

template <std::size_t... N>
constexpr std::array<Avx512Fn, sizeof...(N)> avx512_groups(std::index_sequence<N...>) {
    return {group_avx512<static_cast<int>(N) + 1>...};
}
template <std::size_t... N>
constexpr std::array<Avx2Fn, sizeof...(N)> avx2_groups(std::index_sequence<N...>) {
    return {group_avx2<static_cast<int>(N) + 1>...};
}

constexpr auto kAvx512Groups = avx512_groups(std::make_index_sequence<kCorrelationGroup>());
constexpr auto kAvx2Groups = avx2_groups(std::make_index_sequence<kCorrelationGroup>());

#endif

}  // namespace

SignedPlane::SignedPlane(Isa isa, std::size_t stride, std::size_t rows)
    : isa_(isa),
      stride_(stride),
      bytes_(isa == Isa::kAvx512 ? stride * rows : 0),
      words_(isa == Isa::kAvx512 ? 0 : stride * rows) {
    std::fill((*bytes_).begin(), (*bytes_).end(), std::int8_t{0});
    std::fill((*words_).begin(), (*words_).end(), std::int16_t{0});
}

void SignedPlane::correlate(const std::vector<CorrelationRow>& rows, const std::uint8_t* b,
                            int count, std::int64_t* out) const {
#if defined(__x86_64__)
    const auto group = static_cast<std::size_t>(count - 1);
    if (isa_ == Isa::kAvx512) return kAvx512Groups[group](rows, (*bytes_).data(), stride_, b, out);
    if (isa_ == Isa::kAvx2) return kAvx2Groups[group](rows, (*words_).data(), stride_, b, out);
#endif
    correlate_scalar(rows, (*words_).data(), stride_, b, count, out);
}

}  // namespace weft
