#include "engine/core/plane_warp.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/core/parallel.h"

namespace weft {
namespace {

using glm::dvec2;

constexpr double kSpacingPx = 8;
constexpr double kMostNodes = 250'000;
// Newton's method doubles the correct digits: after a step from so near the rest is below 1e-4 px.
constexpr double kNearPx = 1.0 / 32, kExactPx = 1e-6;

}  // namespace

PlaneWarp::PlaneWarp(WarpNet net) : net_(std::move(net)) {
    const WarpNet::Box box = net_.reach();
    const dvec2 size = box.high - box.low;
    spacing_ = std::max(kSpacingPx, std::sqrt(size.x * size.y / kMostNodes));
    spacing_ = std::max(spacing_, std::max(size.x, size.y) / kMostNodes);
    origin_ = box.low;
    const auto count = [&](double length) { return static_cast<int>(length / spacing_) + 2; };
    nodes_ = {count(size.x), count(size.y)};
    std::vector<dvec2> found(static_cast<std::size_t>(nodes_.width) *
                             static_cast<std::size_t>(nodes_.height));
    parallel_rows(nodes_.height, 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < nodes_.width; ++x) {
                const dvec2 pixel = origin_ + spacing_ * dvec2(x, y);
                found[static_cast<std::size_t>(y) * static_cast<std::size_t>(nodes_.width) +
                      static_cast<std::size_t>(x)] = solved(pixel, pixel, kExactPx) - pixel;
            }
        }
    });
    starts_ = std::move(found);
}

// Newton's method on rest + displacement(rest) = pixel, each step halved until it comes nearer. A
// warp that folds nowhere and moves nothing by more than a bound is one to one (Hadamard), and the
// distance to `pixel` has no other minimum than the answer.
dvec2 PlaneWarp::solved(dvec2 pixel, dvec2 start, double enough) const {
    constexpr int kMostSteps = 60, kMostHalvings = 24;
    dvec2 at = start;
    WarpNet::Place here = net_.moved(at);
    dvec2 off = pixel - here.at;
    for (int step = 0; step < kMostSteps; ++step) {
        const dvec2 by = glm::inverse(here.jacobian) * off;
        if (glm::dot(off, off) <= enough * enough) return at + by;
        double share = 1;
        for (int halving = 0; halving < kMostHalvings; ++halving, share *= 0.5) {
            const WarpNet::Place next = net_.moved(at + share * by);
            const dvec2 left = pixel - next.at;
            if (!(glm::dot(left, left) < glm::dot(off, off))) continue;
            at += share * by;
            here = next;
            off = left;
            break;
        }
    }
    return at;
}

dvec2 PlaneWarp::start(dvec2 pixel) const {
    const dvec2 most(nodes_.width - 1, nodes_.height - 1);
    const dvec2 on = glm::clamp((pixel - origin_) / spacing_, dvec2(0), most);
    const int x = std::min(static_cast<int>(on.x), nodes_.width - 2);
    const int y = std::min(static_cast<int>(on.y), nodes_.height - 2);
    const double tx = on.x - x, ty = on.y - y;
    const dvec2* row =
        &starts_[static_cast<std::size_t>(y) * static_cast<std::size_t>(nodes_.width) +
                 static_cast<std::size_t>(x)];
    const dvec2* below = row + nodes_.width;
    return pixel + glm::mix(glm::mix(row[0], row[1], tx), glm::mix(below[0], below[1], tx), ty);
}

Vec2 PlaneWarp::rest(Vec2 pixel) const {
    const dvec2 at(pixel);
    return Vec2(solved(at, start(at), kNearPx));
}

}  // namespace weft
