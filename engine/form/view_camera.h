#pragma once
#include <cmath>
#include <numbers>

#include "engine/core/geometry.h"

namespace weft {

/// A pinhole camera with square pixels that looks at the middle of the picture. View space: x to
/// the right, y down, z into the scene.
struct ViewCamera {
    double focal_px = 0;
    Vec2 centre{0};

    /// The place at a depth of 1 that a place of the picture shows.
    [[nodiscard]] glm::dvec3 ray(Vec2 pixel) const {
        return {(pixel.x - centre.x) / focal_px, (pixel.y - centre.y) / focal_px, 1.0};
    }
};

/// `fov_deg`: horizontal field of view, between 0 and 180.
[[nodiscard]] inline ViewCamera camera_with(double fov_deg, Size picture) {
    // Long double: see docs/decisions/0002-determinism.md.
    const auto half = static_cast<long double>(fov_deg) * std::numbers::pi_v<long double> / 360;
    const auto focal = static_cast<double>(0.5L * picture.width / std::tan(half));
    return {focal,
            0.5f * Vec2(static_cast<float>(picture.width), static_cast<float>(picture.height))};
}

}  // namespace weft
