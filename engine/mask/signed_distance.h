#pragma once
// Signed distances of a matte's boundary. Mattes are propagated in this form, because it can be
// resampled every frame without softening the edge.

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// Distance in pixels from every pixel centre of `inside` (H×W, non-zero inside) to the boundary,
/// positive inside, clamped to ±`limit_px`. The frame's border is not a boundary. Thread-safe.
[[nodiscard]] ImageF1 signed_distance(ViewU8x1 inside, float limit_px);

/// The distances blurred `passes` times by a small binomial kernel: the staircase of a binary label
/// becomes a line at sub-pixel positions. Distances away from corners stay.
[[nodiscard]] ImageF1 smooth_distance(ViewF1 phi, int passes);

/// 1 where a matte covers at least half of a pixel, else 0.
[[nodiscard]] Image<std::uint8_t, 1> inside_of(ViewU8x1 matte);

/// Bilinear sample of a field at pixel-centre coordinates, clamped to the border.
[[nodiscard]] inline float sample_bilinear(ViewF1 f, float x, float y) {
    x = std::clamp(x, 0.0f, static_cast<float>(f.width() - 1));
    y = std::clamp(y, 0.0f, static_cast<float>(f.height() - 1));
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, f.width() - 1), y1 = std::min(y0 + 1, f.height() - 1);
    const float u = x - static_cast<float>(x0), v = y - static_cast<float>(y0);
    const float* a = f.row(y0);
    const float* b = f.row(y1);
    const float top = a[x0] + u * (a[x1] - a[x0]);
    const float bottom = b[x0] + u * (b[x1] - b[x0]);
    return top + v * (bottom - top);
}

/// The same of a field of vectors.
[[nodiscard]] inline Vec2 sample_bilinear(ViewF2 f, float x, float y) {
    x = std::clamp(x, 0.0f, static_cast<float>(f.width() - 1));
    y = std::clamp(y, 0.0f, static_cast<float>(f.height() - 1));
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, f.width() - 1), y1 = std::min(y0 + 1, f.height() - 1);
    const float u = x - static_cast<float>(x0), v = y - static_cast<float>(y0);
    const auto at = [&](int i, int j) { return Vec2(f.pixel(i, j)[0], f.pixel(i, j)[1]); };
    const Vec2 top = at(x0, y0) + u * (at(x1, y0) - at(x0, y0));
    const Vec2 bottom = at(x0, y1) + u * (at(x1, y1) - at(x0, y1));
    return top + v * (bottom - top);
}

/// How many pixels are inside, where the signed distance is above 0. Pure.
[[nodiscard]] double area_of(ViewF1 phi);

}  // namespace weft
