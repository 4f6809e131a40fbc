#pragma once
// The homography that explains places and where they went.

#include <glm/mat3x3.hpp>
#include <vector>

#include "engine/core/geometry.h"

namespace weft {

/// A place of one frame, px, and where it lies in another.
struct PlacePair {
    Vec2 from{0, 0}, to{0, 0};
};

/// The homography that takes `from` to `to` for most of the pairs: the normalised direct linear
/// transform (Hartley & Zisserman 2004, algorithm 4.1) under Cauchy weights, drawn towards an
/// affine motion as far as 0.5 % of the pairs' extent leave its perspective open. For fewer than 8
/// pairs their mean displacement; without any, the identity. Pure; deterministic.
[[nodiscard]] glm::dmat3 fit_plane(const std::vector<PlacePair>& pairs);

/// Where it takes p; px.
[[nodiscard]] Vec2 mapped(const glm::dmat3& plane, Vec2 p);

}  // namespace weft
