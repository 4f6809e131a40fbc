#include "engine/compute/plane_sampler.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/core/isa.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

using F4 = float __attribute__((vector_size(16)));

F4 spread(float v) {
    return F4{v, v, v, v};
}

// Cells per texel along one axis of the pixel, from the footprint's length in texels.
struct Density {
    int fewest, most;
    [[nodiscard]] int cells(float texels) const {
        return std::clamp(static_cast<int>(std::ceil(2 * texels)), fewest, most);
    }
};

Density density(SampleQuality quality) {
    return quality == SampleQuality::kFinal ? Density{3, 8} : Density{2, 4};
}

// One level and the factors from plane texels to its own.
struct LevelView {
    const PlanePyramid::Level* texels;
    float scale_x, scale_y;
};

// Cubic convolution (Keys 1981) with a = −0.5, Catmull–Rom: averaged over the pixel it keeps the
// plane's sharpness; steeper kernels overshoot it (docs/decisions/0005-sampling-filter.md).
// Polynomials in the fraction, one lane for each of the four texels.
F4 cubic_weights(float f) {
    const F4 t = spread(f);
    const F4 constant{0, 1, 0, 0}, linear{-0.5f, 0, 0.5f, 0};
    const F4 square{1, -2.5f, 2, -0.5f}, cube{-0.5f, 1.5f, -1.5f, 0.5f};
    return constant + t * (linear + t * (square + t * cube));
}

// The coordinate reduced to one period of the plane, to keep its precision.
float folded(float u, int n, WrapMode wrap) {
    if (wrap == WrapMode::kClamp) return std::clamp(u, -1.0f, static_cast<float>(n) + 1);
    const auto period = static_cast<float>(wrap == WrapMode::kMirror ? 2 * n : n);
    return u - period * std::floor(u / period);
}

// Each set puts two texels together, and adds them, in registers: a wide load of what two narrow
// stores wrote waits for both to reach the cache, which took two thirds of all sampling.
namespace portable {
constexpr std::size_t kRegister = 4;
using Lanes = float __attribute__((vector_size(16)));
[[gnu::always_inline]] inline void join(F4 even, F4 odd, Lanes* pair) {
    pair[0] = even;
    pair[1] = odd;
}
[[gnu::always_inline]] inline F4 added(const Lanes* pair) {
    return pair[0] + pair[1];
}
#include "engine/compute/plane_sampler.inl"
}  // namespace portable

#if defined(__x86_64__)
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
namespace avx2 {
constexpr std::size_t kRegister = 8;
using Lanes = float __attribute__((vector_size(32)));
[[gnu::always_inline]] inline void join(F4 even, F4 odd, Lanes* pair) {
    *pair = __builtin_shufflevector(even, odd, 0, 1, 2, 3, 4, 5, 6, 7);
}
[[gnu::always_inline]] inline F4 added(const Lanes* pair) {
    return __builtin_shufflevector(*pair, *pair, 0, 1, 2, 3) +
           __builtin_shufflevector(*pair, *pair, 4, 5, 6, 7);
}
#include "engine/compute/plane_sampler.inl"
}  // namespace avx2
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

template <WrapMode W>
void run(const SampleRequest& request, ImageView<float, 3> out) {
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
#if defined(__x86_64__)
        if (current_isa() != Isa::kScalar) return avx2::sample_rows<W>(request, out, y0, y1);
#endif
        portable::sample_rows<W>(request, out, y0, y1);
    });
}

}  // namespace

void sample_plane_cpu(const SampleRequest& request, ImageView<float, 3> out) {
    switch (request.plane->wrap()) {
        case WrapMode::kRepeat:
            return run<WrapMode::kRepeat>(request, out);
        case WrapMode::kMirror:
            return run<WrapMode::kMirror>(request, out);
        case WrapMode::kClamp:
            return run<WrapMode::kClamp>(request, out);
    }
}

}  // namespace weft
