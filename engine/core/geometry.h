#pragma once
// Pixel geometry. Origin top-left, x right, y down; pixel (x, y) covers [x, x+1) × [y, y+1),
// so its centre lies at (x + 0.5, y + 0.5).

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace weft {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec2i = glm::ivec2;
using Mat3 = glm::mat3;

/// Width and height in pixels, both ≥ 0.
struct Size {
    int width = 0;
    int height = 0;
    bool operator==(const Size&) const = default;
    [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
};

/// Half-open rectangle of pixels [x0, x1) × [y0, y1).
struct Recti {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    bool operator==(const Recti&) const = default;
    [[nodiscard]] int width() const { return x1 - x0; }
    [[nodiscard]] int height() const { return y1 - y0; }
    [[nodiscard]] Size size() const { return {width(), height()}; }
    [[nodiscard]] bool empty() const { return x1 <= x0 || y1 <= y0; }
    [[nodiscard]] bool contains(int x, int y) const {
        return x >= x0 && x < x1 && y >= y0 && y < y1;
    }
    [[nodiscard]] Recti intersected(const Recti& o) const {
        return {std::max(x0, o.x0), std::max(y0, o.y0), std::min(x1, o.x1), std::min(y1, o.y1)};
    }
    /// The smallest rectangle that holds both; an empty one adds nothing.
    [[nodiscard]] Recti united(const Recti& o) const {
        if (empty()) return o;
        if (o.empty()) return *this;
        return {std::min(x0, o.x0), std::min(y0, o.y0), std::max(x1, o.x1), std::max(y1, o.y1)};
    }
    [[nodiscard]] Recti grown(int px) const { return {x0 - px, y0 - px, x1 + px, y1 + px}; }
};

inline Recti rect_of(Size s) {
    return {0, 0, s.width, s.height};
}

/// Projective map of a point: (x, y, 1) through `m`, divided by the third coordinate.
inline Vec2 project(const Mat3& m, Vec2 p) {
    const Vec3 q = m * Vec3(p, 1.0f);
    return Vec2(q.x, q.y) / q.z;
}

}  // namespace weft
