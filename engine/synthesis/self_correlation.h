#pragma once
// A picture's correlation with itself, in which its repeats are peaks.

#include <cmath>
#include <cstdlib>
#include <glm/vec2.hpp>
#include <optional>

#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/synthesis/texture_period.h"

namespace weft {

/// For all moves up to `reach` in either direction; 1 at 0.
struct SelfCorrelation {
    Image<double, 1> values;  ///< At (d.x + reach.x, d.y), d.y ≥ 0.
    Vec2i reach{0, 0};

    [[nodiscard]] bool covers(Vec2i d) const {
        return std::abs(d.x) <= reach.x && std::abs(d.y) <= reach.y;
    }
    /// Of a move that is covered.
    [[nodiscard]] double at(Vec2i d) const {
        return d.y < 0 ? values.at(reach.x - d.x, -d.y) : values.at(reach.x + d.x, d.y);
    }
};

[[nodiscard]] inline Vec2i nearest(glm::dvec2 v) {
    return {static_cast<int>(std::lround(v.x)), static_cast<int>(std::lround(v.y))};
}

[[nodiscard]] SelfCorrelation correlation_of(const SelfMismatch& self);
/// With moves of up to half the picture. Thread-safe.
[[nodiscard]] SelfCorrelation correlation_of(ViewU8x3 picture);

/// The best covered move within `radius` of d in x and y; none if none is covered.
[[nodiscard]] std::optional<Vec2i> best_near(const SelfCorrelation& c, Vec2i d, int radius);

}  // namespace weft
