#include "engine/synthesis/placement_memory.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace weft {
namespace {

constexpr double kReuseTolerance = 0.05;
constexpr int kFarStep_px = 12;

// Of a step and its opposite, the one that leads downwards.
Vec2i downwards(Vec2i d) {
    return d.y < 0 || (d.y == 0 && d.x < 0) ? Vec2i{-d.x, -d.y} : d;
}

}  // namespace

PlacementMemory::PlacementMemory(std::vector<Placed> earlier, Size near)
    : earlier_(std::move(earlier)), near_(near) {
    for (std::size_t i = 0; i < earlier_.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const Vec2i d = earlier_[i].origin - earlier_[j].origin;
            if (neighbours(d)) steps_.push_back(downwards(d));
        }
    }
    std::sort(steps_.begin(), steps_.end(),
              [](Vec2i a, Vec2i b) { return std::pair(a.y, a.x) < std::pair(b.y, b.x); });
}

bool PlacementMemory::neighbours(Vec2i d) const {
    return std::abs(d.x) < near_.width && std::abs(d.y) < near_.height;
}

// The distance of the steps from the neighbours to the nearest earlier step, in pixels, up to
// kFarStep_px.
int PlacementMemory::novelty(Vec2i origin) const {
    int least = kFarStep_px;
    for (const Placed& p : earlier_) {
        const Vec2i d = downwards(origin - p.origin);
        if (!neighbours(d)) continue;
        const auto first = std::lower_bound(steps_.begin(), steps_.end(), d.y - least,
                                            [](Vec2i step, int y) { return step.y < y; });
        for (auto s = first; s != steps_.end() && s->y <= d.y + least; ++s) {
            least = std::min(least, std::max(std::abs(s->x - d.x), std::abs(s->y - d.y)));
        }
    }
    return least;
}

// The share of the patch that shows what a near patch shows, weighted by nearness.
double PlacementMemory::reuse(const Placed& next) const {
    const Recti from = next.from();
    const double area = static_cast<double>(from.width()) * from.height();
    const double reach_x = 2.0 * near_.width, reach_y = 2.0 * near_.height;
    double sum = 0;
    for (const Placed& p : earlier_) {
        const Recti common = from.intersected(p.from());
        if (common.empty()) continue;
        const double far = std::max(std::abs(next.rect.x0 - p.rect.x0) / reach_x,
                                    std::abs(next.rect.y0 - p.rect.y0) / reach_y);
        sum += std::max(0.0, 1.0 - far) * common.width() * common.height() / area;
    }
    return sum;
}

std::vector<Vec2i> PlacementMemory::least_repetitive(const std::vector<Vec2i>& origins,
                                                     const Recti& rect) const {
    std::vector<double> costs;
    costs.reserve(origins.size());
    for (const Vec2i o : origins)
        costs.push_back(reuse({o, rect}));
    const double limit = *std::min_element(costs.begin(), costs.end()) + kReuseTolerance;
    std::vector<int> novelties(origins.size(), -1);
    int most = 0;
    for (std::size_t i = 0; i < origins.size(); ++i) {
        if (costs[i] > limit) continue;
        novelties[i] = novelty(origins[i]);
        most = std::max(most, novelties[i]);
    }
    std::vector<Vec2i> out;
    for (std::size_t i = 0; i < origins.size(); ++i) {
        if (novelties[i] >= 0 && 3 * novelties[i] >= 2 * most) out.push_back(origins[i]);
    }
    return out;
}

}  // namespace weft
