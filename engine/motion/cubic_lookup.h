#pragma once
// Internal: Catmull–Rom weights of four neighbours, as vectors.

#include <cstring>

namespace weft {

using F4 = float __attribute__((vector_size(16)));

inline F4 load(const float* from) {
    F4 v;
    std::memcpy(&v, from, sizeof v);
    return v;
}

inline float dot(F4 a, F4 b) {
    const F4 v = a * b;
    return (v[0] + v[2]) + (v[1] + v[3]);
}

/// Weights of the neighbours −1, 0, 1, 2 at fraction t, and their derivatives.
inline F4 weights_at(float t) {
    const float t2 = t * t, t3 = t2 * t;
    return F4{-0.5f * t + t2 - 0.5f * t3, 1 - 2.5f * t2 + 1.5f * t3, 0.5f * t + 2 * t2 - 1.5f * t3,
              -0.5f * t2 + 0.5f * t3};
}
inline F4 slopes_at(float t) {
    const float t2 = t * t;
    return F4{-0.5f + 2 * t - 1.5f * t2, -5 * t + 4.5f * t2, 0.5f + 4 * t - 4.5f * t2,
              -t + 1.5f * t2};
}

}  // namespace weft
