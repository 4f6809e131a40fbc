#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace weft {

/// A vector at the length 1. Divides, where glm::normalize() multiplies by a reciprocal.
[[nodiscard]] inline glm::dvec3 unit(const glm::dvec3& v) {
    return v / std::sqrt(glm::dot(v, v));
}

}  // namespace weft
