#pragma once
// The homography that explains places and where they went.

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "engine/core/geometry.h"

namespace weft {

/// A place of one frame, px, and where it lies in another.
struct PlacePair {
    Vec2 from{0, 0}, to{0, 0};
};

struct PlaneFitOptions {
    /// Of reweighting.
    int rounds = 15;
    /// Fewer pairs give their mean displacement (median, if it begins with that); at least 8.
    std::size_t fewest = 8;
    /// Begins with what is near the median displacement instead of with all pairs alike: a third of
    /// a frame that moves otherwise would drag a fit of all.
    bool from_median = false;
};

/// The homography that takes `from` to `to` for most of the pairs: the normalised direct linear
/// transform (Hartley & Zisserman 2004, algorithm 4.1) under Cauchy weights, drawn towards an
/// affine motion as far as 0.5 % of the pairs' extent leave its perspective open. Without any pair
/// the identity. Pure; deterministic; linear in the number of pairs.
[[nodiscard]] glm::dmat3 fit_plane(const std::vector<PlacePair>& pairs,
                                   const PlaneFitOptions& options = {});

/// The same by plain least squares over all pairs, for places that are known to lie on a plane.
/// Empty for fewer than four pairs, or if they do not determine it.
[[nodiscard]] std::optional<glm::dmat3> fit_homography(const std::vector<PlacePair>& pairs);

/// Where it takes p; px.
[[nodiscard]] Vec2 mapped(const glm::dmat3& plane, Vec2 p);

/// As deep as a homography is followed beyond what it was fitted to: half of the least of `depths`
/// (the third coordinates of those places), or a twentieth of their median where that is more. A
/// field over the whole frame continues with this depth, as an affine motion; at the horizon it
/// would be infinite, and what is composed with it or bends beside it would be drawn along. 1
/// without any place. Pure.
[[nodiscard]] double nearest_depth(std::vector<double> depths);

/// How far it moves p; px.
[[nodiscard]] Vec2 moved_by(const glm::dmat3& plane, Vec2 p);

}  // namespace weft
