#include "engine/synthesis/placement_memory.h"

#include <algorithm>
#include <cstdlib>

namespace weft {
namespace {

constexpr double kReuseTolerance = 0.05;

std::int64_t step_key(Vec2i d) {
    if (d.y < 0 || (d.y == 0 && d.x < 0)) d = {-d.x, -d.y};
    return static_cast<std::int64_t>(d.y) * (std::int64_t{1} << 32) + d.x;
}

}  // namespace

PlacementMemory::PlacementMemory(std::vector<Placed> earlier, Size near)
    : earlier_(std::move(earlier)), near_(near) {
    for (std::size_t i = 0; i < earlier_.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const Vec2i d = earlier_[i].origin - earlier_[j].origin;
            if (neighbours(d)) steps_.push_back(step_key(d));
        }
    }
    std::sort(steps_.begin(), steps_.end());
}

bool PlacementMemory::neighbours(Vec2i d) const {
    return std::abs(d.x) < near_.width && std::abs(d.y) < near_.height;
}

bool PlacementMemory::repeats_a_step(Vec2i origin) const {
    return std::any_of(earlier_.begin(), earlier_.end(), [&](const Placed& p) {
        const Vec2i d = origin - p.origin;
        return neighbours(d) && std::binary_search(steps_.begin(), steps_.end(), step_key(d));
    });
}

// Shares of the patch that show what a near patch shows, the nearer the more.
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
    std::vector<Vec2i> out, fresh;
    for (std::size_t i = 0; i < origins.size(); ++i) {
        if (costs[i] > limit) continue;
        out.push_back(origins[i]);
        if (!repeats_a_step(origins[i])) fresh.push_back(origins[i]);
    }
    return fresh.empty() ? out : fresh;
}

}  // namespace weft
