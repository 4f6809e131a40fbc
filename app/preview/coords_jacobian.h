#pragma once
// Internal to the overlays: how texture coordinates change from pixel to pixel.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/core/image.h"

namespace weft {

/// A value from 0 to 1 as a pixel of an overlay.
[[nodiscard]] inline std::uint8_t code(float v) {
    return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
}

struct Jacobian {
    float xx, xy, yx, yy;  // d(u, v) / d(x, y)
    [[nodiscard]] float along_u() const { return std::hypot(xx, xy); }
    [[nodiscard]] float along_v() const { return std::hypot(yx, yy); }
    [[nodiscard]] float area() const { return std::abs(xx * yy - xy * yx); }
};

[[nodiscard]] inline Jacobian jacobian(const ImageF2& uv, int x, int y) {
    const int x1 = std::min(x + 1, uv.width() - 1), y1 = std::min(y + 1, uv.height() - 1);
    const int x0 = std::max(0, x1 - 1), y0 = std::max(0, y1 - 1);
    return {uv.pixel(x1, y)[0] - uv.pixel(x0, y)[0], uv.pixel(x, y1)[0] - uv.pixel(x, y0)[0],
            uv.pixel(x1, y)[1] - uv.pixel(x0, y)[1], uv.pixel(x, y1)[1] - uv.pixel(x, y0)[1]};
}

}  // namespace weft
