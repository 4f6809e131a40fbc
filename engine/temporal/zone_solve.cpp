#include "engine/temporal/zone_solve.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace weft {
namespace {

constexpr std::array<Vec2i, 4> kNeighbours{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
constexpr std::uint8_t kInside = 128;

// The largest coverage within `spacings` of each node, row by row.
std::vector<std::uint8_t> largest_near(ViewU8x1 matte, const LatticeField& field, int spacings) {
    const int s = field.spacing(), margin = LatticeField::kMargin;
    const Size cells{(matte.width() + s - 1) / s, (matte.height() + s - 1) / s};
    Matte of_cell(cells);
    for (int y = 0; y < matte.height(); ++y) {
        const std::uint8_t* row = matte.row(y);
        std::uint8_t* out = of_cell.row(y / s);
        for (int x = 0; x < matte.width(); ++x)
            out[x / s] = std::max(out[x / s], row[x]);
    }
    const ImageF2& nodes = field.nodes();
    std::vector<std::uint8_t> found;
    found.reserve(static_cast<std::size_t>(nodes.width()) *
                  static_cast<std::size_t>(nodes.height()));
    for (int j = 0; j < nodes.height(); ++j) {
        for (int i = 0; i < nodes.width(); ++i) {
            std::uint8_t largest = 0;
            const int x0 = i - margin - spacings, x1 = i - margin + spacings;
            const int y0 = j - margin - spacings, y1 = j - margin + spacings;
            for (int y = std::max(0, y0); y < std::min(cells.height, y1); ++y)
                for (int x = std::max(0, x0); x < std::min(cells.width, x1); ++x)
                    largest = std::max(largest, of_cell.at(x, y));
            found.push_back(largest);
        }
    }
    return found;
}

// The surface outside of the zone.
Matte rest_of(const MotionZone& zone) {
    Matte out(zone.surface.size());
    for (int y = 0; y < out.height(); ++y) {
        const std::uint8_t *surface = zone.surface.row(y), *inside = zone.matte.row(y);
        std::transform(surface, surface + out.width(), inside, out.row(y),
                       [](std::uint8_t s, std::uint8_t z) { return z == 0 ? s : std::uint8_t{0}; });
    }
    return out;
}

}  // namespace

ZoneSolve::ZoneSolve(const LatticeField& field, const MotionZone& zone)
    : field_(field),
      zone_(zone),
      size_(field.nodes().size()),
      zone_near_(largest_near(zone.matte, field, 1)),
      surface_near_(largest_near(zone.surface, field, 1)) {
    // Beyond the surface's edge so do the nodes on which pixels inside depend too.
    const std::vector<std::uint8_t> further = largest_near(zone.matte, field, 2),
                                    rest = largest_near(rest_of(zone), field, 2);
    for (std::size_t k = 0; k < zone_near_.size(); ++k)
        if (rest[k] == 0) zone_near_[k] = std::max(zone_near_[k], further[k]);
    for (int j = 0; j < size_.height; ++j) {
        for (int i = 0; i < size_.width; ++i) {
            if (zone_near_[at(i, j)] == 0) continue;
            free_.emplace_back(i, j);
            for (const Vec2i step : kNeighbours) {
                const Vec2i n = Vec2i(i, j) + step;
                const bool there = n.x >= 0 && n.y >= 0 && n.x < size_.width && n.y < size_.height;
                held_ |= there && zone_near_[at(n.x, n.y)] == 0 &&
                         surface_near_[at(n.x, n.y)] >= kInside;
            }
        }
    }
}

LatticeField ZoneSolve::towards(const std::function<Vec2(Vec2)>& guide, double reach) const {
    constexpr double kOver = 1.7, kEnough_px = 2e-4;
    constexpr int kMost = 500;
    std::vector<Vec2> guided(zone_near_.size(), Vec2(0));
    std::vector<glm::dvec2> v(zone_near_.size(), glm::dvec2(0));
    // Nodes whose v is known or sought; the others hold nothing.
    std::vector<std::uint8_t> counts(zone_near_.size(), 0);
    for (const Vec2i node : free_) {
        guided[at(node.x, node.y)] = guide(field_.node_position(node.x, node.y));
        counts[at(node.x, node.y)] = 1;
        for (const Vec2i step : kNeighbours) {
            const Vec2i n = node + step;
            if (n.x < 0 || n.y < 0 || n.x >= size_.width || n.y >= size_.height) continue;
            const std::size_t k = at(n.x, n.y);
            if (counts[k] || zone_near_[k] != 0 || surface_near_[k] < kInside) continue;
            counts[k] = 1;
            v[k] = field_.node(n.x, n.y) - guide(field_.node_position(n.x, n.y));
        }
    }
    const double pull = reach > 0 ? 1 / (reach * reach) : 1e-6;
    for (int sweep = 0; sweep < kMost; ++sweep) {
        double largest = 0;
        for (const Vec2i node : free_) {
            glm::dvec2 sum(0);
            double weight = pull;
            for (const Vec2i step : kNeighbours) {
                const Vec2i n = node + step;
                if (n.x < 0 || n.y < 0 || n.x >= size_.width || n.y >= size_.height) continue;
                const std::size_t k = at(n.x, n.y);
                if (!counts[k]) continue;
                sum += v[k];
                weight += 1;
            }
            glm::dvec2& here = v[at(node.x, node.y)];
            const glm::dvec2 change = kOver * (sum / weight - here);
            here += change;
            largest = std::max({largest, std::abs(change.x), std::abs(change.y)});
        }
        if (largest < kEnough_px) break;
    }
    LatticeField out = field_;
    for (const Vec2i node : free_) {
        const std::size_t k = at(node.x, node.y);
        const float share = zone_.amount * static_cast<float>(zone_near_[k]) / 255.0f;
        const Vec2 old = field_.node(node.x, node.y);
        out.set_node(node.x, node.y, old + share * (guided[k] + Vec2(v[k]) - old));
    }
    return out;
}

void ZoneSolve::each_place(const std::function<void(Vec2, bool in_zone)>& visit) const {
    const int step = std::max(1, field_.spacing() / 2);
    for (int y = step / 2; y < zone_.surface.height(); y += step) {
        for (int x = step / 2; x < zone_.surface.width(); x += step) {
            if (zone_.surface.row(y)[x] < kInside) continue;
            visit({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f},
                  zone_.matte.row(y)[x] >= kInside);
        }
    }
}

void ZoneSolve::each_inside(const std::function<void(Vec2)>& visit) const {
    each_place([&](Vec2 p, bool in_zone) {
        if (in_zone) visit(p);
    });
}

void ZoneSolve::each_around(int around, const std::function<void(Vec2)>& visit) const {
    // Where the zone acts, grown by a node a round.
    std::vector<std::uint8_t> near = zone_near_;
    for (int round = 0; round < around; ++round) {
        const std::vector<std::uint8_t> before = near;
        for (int j = 0; j < size_.height; ++j) {
            for (int i = 0; i < size_.width; ++i) {
                for (const Vec2i step : kNeighbours) {
                    const Vec2i n = Vec2i(i, j) + step;
                    if (n.x < 0 || n.y < 0 || n.x >= size_.width || n.y >= size_.height) continue;
                    if (before[at(n.x, n.y)]) near[at(i, j)] = 255;
                }
            }
        }
    }
    const auto node_of = [&](Vec2 p) {
        const Vec2 q = p / static_cast<float>(field_.spacing()) + 0.5f +
                       static_cast<float>(LatticeField::kMargin);
        return at(static_cast<int>(q.x), static_cast<int>(q.y));
    };
    each_place([&](Vec2 p, bool /*in_zone*/) {
        const std::size_t k = node_of(p);
        if (near[k] && zone_near_[k] == 0) visit(p);
    });
}

}  // namespace weft
