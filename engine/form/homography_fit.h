#pragma once
#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "engine/core/geometry.h"

namespace weft {

/// The homography that takes places near enough to 0 (|x| ≲ 1) to others, by the direct linear
/// transform (Hartley & Zisserman 2004, algorithm 4.1). Empty for fewer than four pairs, or if they
/// do not determine it.
[[nodiscard]] std::optional<Eigen::Matrix3d> fit_homography(
    const std::vector<Eigen::Vector2d>& from, const std::vector<Eigen::Vector2d>& to);

}  // namespace weft
