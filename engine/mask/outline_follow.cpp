#include "engine/mask/outline_follow.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>

namespace weft {
namespace {

constexpr double kLeastGap = 0.2;    // of what the length of an arc was before
constexpr double kMostShare = 0.9;   // of an outline, that lies near the other
constexpr double kSampleStepPx = 3;  // along an outline, to compare it
constexpr double kFullTurn = 6.283185307179586;

// How far a point is ahead of where its share of the length puts it, as a share of the length.
struct PointLead {
    bool known = false;
    double share = 0;
};

double wrapped(double share) {
    return share - std::round(share);
}

// The mean of known leads, round the circle.
double mean_lead(const std::vector<PointLead>& leads) {
    double x = 0, y = 0;
    for (const PointLead& lead : leads) {
        if (!lead.known) continue;
        x += std::cos(kFullTurn * lead.share);
        y += std::sin(kFullTurn * lead.share);
    }
    return x == 0 && y == 0 ? 0.0 : std::atan2(y, x) / kFullTurn;
}

// Unknown ones get what the known ones beside them have, by share of the length.
void fill_leads(std::vector<PointLead>& leads, const std::vector<CarriedPoint>& points) {
    const std::size_t count = leads.size();
    const std::vector<PointLead> found = leads;
    for (std::size_t k = 0; k < count; ++k) {
        if (found[k].known) continue;
        std::size_t back = 1, ahead = 1;
        while (back < count && !found[(k + count - back) % count].known)
            ++back;
        while (ahead < count && !found[(k + ahead) % count].known)
            ++ahead;
        if (back == count) return;  // none is known: zeros
        const std::size_t a = (k + count - back) % count, b = (k + ahead) % count;
        const double before = std::abs(points[k].share - points[a].share + (a > k ? 1 : 0));
        const double after = std::abs(points[b].share - points[k].share + (b < k ? 1 : 0));
        const double t = before + after > 0 ? before / (before + after) : 0.5;
        leads[k].share = found[a].share + t * (found[b].share - found[a].share);
    }
}

// Pool adjacent violators: the nearest values that never fall.
void make_ascending(std::vector<double>& values) {
    struct Pool {
        double sum = 0;
        std::size_t count = 0;
        [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
    };
    std::vector<Pool> pools;
    for (const double value : values) {
        pools.push_back({value, 1});
        while (pools.size() > 1 && pools.back().mean() < pools[pools.size() - 2].mean()) {
            const Pool last = pools.back();
            pools.pop_back();
            pools.back().sum += last.sum;
            pools.back().count += last.count;
        }
    }
    values.clear();
    for (const Pool& pool : pools)
        values.insert(values.end(), pool.count, pool.mean());
}

// No arc is shorter than a fifth of what it was; what that takes comes off the others.
void keep_gaps(std::vector<double>& places, const std::vector<CarriedPoint>& points) {
    const std::size_t count = places.size();
    std::vector<double> gaps(count);
    double spare = 0, all = 0;
    const auto least = [&](std::size_t k) {
        const double next = k + 1 < count ? points[k + 1].share : points.front().share + 1;
        return kLeastGap * std::max(0.0, next - points[k].share);
    };
    for (std::size_t k = 0; k < count; ++k) {
        const double next = k + 1 < count ? places[k + 1] : places.front() + 1;
        gaps[k] = std::max(next - places[k], least(k));
        all += gaps[k];
        spare += gaps[k] - least(k);
    }
    const double shrink = spare > 0 ? (spare - (all - 1)) / spare : 1.0;
    double place = places.front();
    for (std::size_t k = 0; k < count; ++k) {
        places[k] = place;
        place += least(k) + shrink * (gaps[k] - least(k));
    }
}

float distance_to_any(Vec2 p, const std::vector<Vec2>& others) {
    float least = std::numeric_limits<float>::infinity();
    for (const Vec2 q : others)
        least = std::min(least, glm::dot(q - p, q - p));
    return std::sqrt(least);
}

std::vector<Vec2> sampled_points(const std::vector<Vec2>& polygon) {
    const OutlinePath path(polygon);
    const int count = std::max(8, static_cast<int>(path.length() / kSampleStepPx));
    std::vector<Vec2> out;
    for (int k = 0; k < count; ++k)
        out.push_back(path.at(path.length() * k / count));
    return out;
}

}  // namespace

std::vector<double> followed_places(const OutlinePath& outline,
                                    const std::vector<CarriedPoint>& points, float reach_px) {
    const double length = outline.length();
    std::vector<PointLead> leads(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
        const OutlinePath::Nearest nearest = outline.nearest(points[k].at, points[k].along);
        if (!(nearest.distance_px <= reach_px)) continue;
        leads[k] = {true, nearest.place / length - points[k].share};
    }
    const double mean = mean_lead(leads);
    for (PointLead& lead : leads)
        if (lead.known) lead.share = wrapped(lead.share - mean);
    fill_leads(leads, points);
    std::vector<double> places(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
        places[k] = points[k].share + leads[k].share;
    make_ascending(places);
    // Round the whole outline and no further.
    for (double& place : places)
        place = std::min(place, places.front() + 1);
    keep_gaps(places, points);
    for (double& place : places)
        place = (place + mean) * length;
    return places;
}

SameOutline same_outline(const std::vector<Vec2>& carried, const OutlinePath& outline,
                         float reach_px) {
    const std::vector<Vec2> a = sampled_points(carried), b = sampled_points(outline.points());
    double sum = 0;
    for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        std::size_t near = 0;
        for (const Vec2 p : *from) {
            const float distance = distance_to_any(p, *to);
            sum += static_cast<double>(distance) / static_cast<double>(2 * from->size());
            near += distance <= reach_px ? 1 : 0;
        }
        if (static_cast<double>(near) < kMostShare * static_cast<double>(from->size())) return {};
    }
    return {true, static_cast<float>(sum)};
}

}  // namespace weft
