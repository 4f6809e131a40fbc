#pragma once
// Quadrilaterals and the projective maps onto them.

#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

namespace weft {

/// Four corners in order: top left, top right, bottom right, bottom left.
template <class T>
using Quad = std::array<glm::vec<2, T>, 4>;

/// The homography of the unit square onto four corners in order (Heckbert 1989, eq. 2.9–2.11). The
/// corners must be convex.
template <class T>
[[nodiscard]] glm::mat<3, 3, T> square_to_quad(const Quad<T>& q) {
    const glm::vec<2, T> d1 = q[1] - q[2], d2 = q[3] - q[2], s = q[0] - q[1] + q[2] - q[3];
    const T den = d1.x * d2.y - d2.x * d1.y;
    const T g = (s.x * d2.y - d2.x * s.y) / den;
    const T h = (d1.x * s.y - s.x * d1.y) / den;
    const glm::vec<2, T> u = q[1] - q[0] + g * q[1], v = q[3] - q[0] + h * q[3];
    return {u.x, u.y, g, v.x, v.y, h, q[0].x, q[0].y, 1};
}

/// Whether the corners go around a convex quadrilateral that is not degenerate, either way round.
template <class T>
[[nodiscard]] bool is_convex(const Quad<T>& q) {
    int positive = 0, negative = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::vec<2, T> a = q[(k + 1) % 4] - q[k], b = q[(k + 2) % 4] - q[(k + 1) % 4];
        const T cross = a.x * b.y - a.y * b.x;
        positive += cross > T(1e-3);
        negative += cross < T(-1e-3);
    }
    return positive == 4 || negative == 4;
}

}  // namespace weft
