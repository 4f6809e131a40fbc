#include "engine/mask/outline_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace weft {
namespace {

double length_between(Vec2 a, Vec2 b) {
    const double x = static_cast<double>(b.x) - static_cast<double>(a.x);
    const double y = static_cast<double>(b.y) - static_cast<double>(a.y);
    return std::sqrt(x * x + y * y);
}

}  // namespace

OutlinePath::OutlinePath(std::vector<Vec2> points) : points_(std::move(points)) {
    assert(points_.size() >= 3);
    from_.reserve(points_.size() + 1);
    from_.push_back(0);
    for (std::size_t k = 0; k < points_.size(); ++k)
        from_.push_back(from_.back() +
                        length_between(points_[k], points_[(k + 1) % points_.size()]));
}

Vec2 OutlinePath::at(double place) const {
    const double whole = length();
    if (!(whole > 0)) return points_.front();
    const double s = std::clamp(place - whole * std::floor(place / whole), 0.0, whole);
    const auto after = std::upper_bound(from_.begin() + 1, from_.end() - 1, s);
    const auto k = static_cast<std::size_t>(after - from_.begin()) - 1;
    const double side = from_[k + 1] - from_[k];
    const auto t = static_cast<float>(side > 0 ? (s - from_[k]) / side : 0.0);
    const Vec2 a = points_[k], b = points_[(k + 1) % points_.size()];
    return a + t * (b - a);
}

Vec2 OutlinePath::direction(double place, int side, double reach_px) const {
    const Vec2 here = at(place), there = at(place + side * reach_px);
    const Vec2 way = static_cast<float>(side) * (there - here);
    const float size = glm::length(way);
    return size > 1e-6f ? way / size : Vec2(0.0f);
}

OutlinePath::Nearest OutlinePath::nearest(Vec2 p, Vec2 along) const {
    Nearest best{0, std::numeric_limits<float>::infinity()};
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < points_.size(); ++k) {
        const Vec2 a = points_[k], side = points_[(k + 1) % points_.size()] - a;
        if (glm::dot(side, along) < 0) continue;
        const float square = glm::dot(side, side);
        const float t = square > 0 ? std::clamp(glm::dot(p - a, side) / square, 0.0f, 1.0f) : 0.0f;
        const Vec2 off = p - a - t * side;
        const float distance = glm::dot(off, off);
        if (!(distance < least)) continue;
        least = distance;
        best.place = from_[k] + static_cast<double>(t) * (from_[k + 1] - from_[k]);
    }
    best.distance_px = std::sqrt(least);
    return best;
}

}  // namespace weft
