#pragma once
#include <Eigen/Core>
#include <glm/mat3x3.hpp>

namespace weft {

using Vector3 = Eigen::Vector3d;
using Vector4 = Eigen::Vector4d;
using Matrix3 = Eigen::Matrix3d;
using Matrix4 = Eigen::Matrix4d;

/// A homography of pixels as one of places from `middle` (px), in units of `unit_px`.
[[nodiscard]] inline Matrix3 in_units(const glm::dmat3& map, glm::dvec2 middle, double unit_px) {
    Matrix3 pixels, there, back;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            pixels(row, column) = map[column][row];
    back << unit_px, 0, middle.x, 0, unit_px, middle.y, 0, 0, 1;
    there << 1, 0, -middle.x, 0, 1, -middle.y, 0, 0, unit_px;
    return there * pixels * back / unit_px;
}

}  // namespace weft
