#include "engine/synthesis/repetition.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/synthesis/autocovariance.h"

namespace weft {
namespace {

constexpr int kLargestMeasured = 768;
constexpr int kLeastRepeat = 12;
constexpr int kSourceGrid = 4;  // Every 4th of the sample's pixels in x and y is checked.
constexpr double kPeriodTolerance_px = 2.5;

Recti middle(Size s) {
    const int w = std::min(s.width, kLargestMeasured), h = std::min(s.height, kLargestMeasured);
    const int x0 = (s.width - w) / 2, y0 = (s.height - h) / 2;
    return {x0, y0, x0 + w, y0 + h};
}

bool is_peak(const Image<double, 1>& c, int x, int y) {
    const double here = c.at(x, y);
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            // Above the first row the autocovariance is its own half-turn.
            const int ny = y + dy, nx = x + dx;
            const double there = ny < 0 ? c.at(c.width() - 1 - nx, -ny) : c.at(nx, ny);
            if (there > here) return false;
        }
    }
    return true;
}

void find_verbatim(const TexturePlane& plane, Repetition& out) {
    const Recti part = middle(plane.source.size());
    const Vec2i reach{part.width() / 2, part.height() / 2};
    struct Shown {
        std::uint64_t key;
        Vec2i at;
    };
    std::vector<Shown> shown;
    for (int y = part.y0; y < part.y1; ++y) {
        for (int x = part.x0; x < part.x1; ++x) {
            const std::int32_t* s = plane.source.pixel(x, y);
            if (s[0] % kSourceGrid != 0 || s[1] % kSourceGrid != 0) continue;
            const std::uint64_t sample = plane.origin.empty() ? 0
                                                              : plane.origin.pixel(x, y)[0] * 8u +
                                                                    plane.origin.pixel(x, y)[1];
            shown.push_back({sample << 48 | static_cast<std::uint64_t>(s[1]) << 24 |
                                 static_cast<std::uint64_t>(s[0]),
                             {x, y}});
        }
    }
    std::stable_sort(shown.begin(), shown.end(),
                     [](const Shown& a, const Shown& b) { return a.key < b.key; });
    Image<std::int32_t, 1> counts(2 * reach.x + 1, reach.y + 1, 0);
    for (std::size_t i = 0; i < shown.size(); ++i) {
        for (std::size_t j = i + 1; j < shown.size() && shown[j].key == shown[i].key; ++j) {
            const Vec2i d = shown[j].at - shown[i].at;  // Rows ascend within a key.
            if (d.y > reach.y) break;
            if (std::abs(d.x) <= reach.x) ++counts.at(d.x + reach.x, d.y);
        }
    }
    for (int dy = 0; dy <= reach.y; ++dy) {
        for (int dx = -reach.x; dx <= reach.x; ++dx) {
            const double pairs = static_cast<double>(part.width() - std::abs(dx)) *
                                 (part.height() - dy) / (kSourceGrid * kSourceGrid);
            const double share = std::min(1.0, counts.at(dx + reach.x, dy) / pairs);
            if (share > out.verbatim) out.verbatim = share, out.verbatim_at = {dx, dy};
        }
    }
}

// `own`: true for steps of the texture's own period.
template <class Own>
Repetition measure(ViewU8x3 picture, const Own& own_step) {
    Repetition out;
    const ViewU8x3 part = picture.crop(middle(picture.size()));
    const Vec2i reach{part.width() / 2, part.height() / 2};
    if (reach.x < kLeastRepeat || reach.y < kLeastRepeat) return out;
    const Image<double, 1> c = autocovariance(part, reach);
    const double variance = c.at(reach.x, 0);
    if (variance < 1e-3) return out;
    for (int dy = 0; dy < reach.y; ++dy) {
        for (int dx = -reach.x + 1; dx < reach.x; ++dx) {
            if ((dy == 0 && dx <= 0) || std::hypot(dx, dy) < kLeastRepeat) continue;
            const double value = c.at(dx + reach.x, dy) / variance;
            const bool own = own_step(Vec2i{dx, dy});
            if (value <= (own ? out.own_period : out.peak)) continue;
            if (!is_peak(c, dx + reach.x, dy)) continue;
            if (own) {
                out.own_period = value;
            } else {
                out.peak = value, out.peak_at = {dx, dy};
            }
        }
    }
    return out;
}

}  // namespace

Repetition measure_repetition(ViewU8x3 picture, const TexturePeriod& period) {
    return measure(
        picture, [&](Vec2i d) { return period.count > 0 && period.holds(d, kPeriodTolerance_px); });
}

Repetition measure_repetition(const TexturePlane& plane) {
    const PlaneLattice& lattice = plane.stats.lattice;
    Repetition out = lattice.empty() ? measure_repetition(plane.pixels.view(), plane.stats.period)
                                     : measure(plane.pixels.view(), [&](Vec2i d) {
                                           return glm::length(lattice.miss(glm::dvec2(d))) <=
                                                  kPeriodTolerance_px;
                                       });
    find_verbatim(plane, out);
    return out;
}

}  // namespace weft
