#include "engine/metrics/light_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "engine/color/color_space.h"

namespace weft {
namespace {

constexpr double kGrey = 0.35;  // linear reflectance

double level(double light) {
    return 255.0 * static_cast<double>(linear_to_srgb(static_cast<float>(kGrey * light)));
}

bool usable(float v) {
    return std::isfinite(v) && v > 0;
}

template <class Visit>
void for_each_inside(ViewF1 a, ViewF1 b, ViewU8x1 inside, const Visit& visit) {
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const float p = a.row(y)[x], q = b.row(y)[x];
            if (inside.row(y)[x] == 255 && usable(p) && usable(q)) visit(p, q);
        }
    }
}

// Profiles across an edge.
constexpr int kProfileReach = 14;     // px to each side
constexpr int kAcross = 12;           // the gradient is the maximum within this many px
constexpr int kBeside = 5;            // parallel profiles to each side, averaged against noise
constexpr int kStep = 6;              // px between places that are tried
constexpr double kLeastStep = 0.2;    // of ln light from one end of a profile to the other
constexpr double kLeastSlope = 0.02;  // of ln light a px, in the middle
constexpr int kEnds = 4;              // samples at each end that give its level
using Profile = std::array<double, 2 * kProfileReach + 1>;

ImageF1 log_of(ViewF1 light) {
    ImageF1 out(light.size());
    for (int y = 0; y < light.height(); ++y) {
        for (int x = 0; x < light.width(); ++x)
            out.row(y)[x] = usable(light.row(y)[x]) ? std::log(light.row(y)[x]) : -20.0f;
    }
    return out;
}

bool all_inside(ViewU8x1 inside, double x, double y) {
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    return i >= 0 && j >= 0 && i + 1 < inside.width() && j + 1 < inside.height() &&
           inside.row(j)[i] == 255 && inside.row(j)[i + 1] == 255 && inside.row(j + 1)[i] == 255 &&
           inside.row(j + 1)[i + 1] == 255;
}

double bilinear(const ImageF1& p, double x, double y) {
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const double fx = x - i, fy = y - j;
    const float *a = p.row(j) + i, *b = p.row(j + 1) + i;
    return (1 - fy) * ((1 - fx) * a[0] + fx * a[1]) + fy * ((1 - fx) * b[0] + fx * b[1]);
}

struct Direction {
    double x, y;
};

// The mean of parallel profiles through (x, y) along the direction; false where one leaves the
// region.
bool profile_at(const ImageF1& light, ViewU8x1 inside, double x, double y, Direction d,
                Profile& out) {
    out.fill(0);
    for (int s = -kBeside; s <= kBeside; ++s) {
        for (int t = -kProfileReach; t <= kProfileReach; ++t) {
            const double u = x + t * d.x - s * d.y, v = y + t * d.y + s * d.x;
            if (!all_inside(inside, u, v)) return false;
            out[static_cast<std::size_t>(t + kProfileReach)] += bilinear(light, u, v);
        }
    }
    for (double& v : out)
        v /= 2 * kBeside + 1;
    return true;
}

struct Edge {
    double middle, width;
};

// Where the profile crosses 10, 50 and 90 % of its step; empty if it has no clear step.
std::optional<Edge> edge_of(const Profile& p) {
    double low = 0, high = 0;
    for (std::size_t k = 0; k < kEnds; ++k)
        low += p[k] / kEnds, high += p[p.size() - 1 - k] / kEnds;
    if (std::abs(high - low) < 0.5 * kLeastStep) return std::nullopt;
    const auto crossing = [&](double share) -> std::optional<double> {
        std::optional<double> best;
        for (std::size_t k = 0; k + 1 < p.size(); ++k) {
            const double a = (p[k] - low) / (high - low), b = (p[k + 1] - low) / (high - low);
            if (!(a < share && share <= b)) continue;
            const double at = static_cast<double>(k) + (share - a) / (b - a) - kProfileReach;
            if (!best || std::abs(at) < std::abs(*best)) best = at;
        }
        return best;
    };
    const auto a = crossing(0.1), b = crossing(0.5), c = crossing(0.9);
    if (!a || !b || !c || !(*c > *a)) return std::nullopt;
    return Edge{*b, *c - *a};
}

double median(std::vector<double> v, double share) {
    if (v.empty()) return 0;
    const auto at =
        v.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(v.size() - 1));
    std::nth_element(v.begin(), at, v.end());
    return *at;
}

}  // namespace

ShadingAgreement compare_shading(ViewF1 estimated, ViewF1 truth, ViewU8x1 inside) {
    ShadingAgreement out;
    double mean_e = 0, mean_t = 0;
    for_each_inside(estimated, truth, inside, [&](double e, double t) {
        ++out.pixels;
        mean_e += e, mean_t += t;
    });
    if (out.pixels == 0) return out;
    const auto n = static_cast<double>(out.pixels);
    mean_e /= n, mean_t /= n;
    double ee = 0, tt = 0, et = 0, difference = 0, level_sum = 0, level_squares = 0;
    for_each_inside(estimated, truth, inside, [&](double e, double t) {
        ee += (e - mean_e) * (e - mean_e);
        tt += (t - mean_t) * (t - mean_t);
        et += (e - mean_e) * (t - mean_t);
        const double true_level = level(t / mean_t);
        difference += std::abs(level(e / mean_e) - true_level);
        level_sum += true_level, level_squares += true_level * true_level;
    });
    if (ee > 0 && tt > 0) out.correlation = et / std::sqrt(ee * tt);
    out.error_levels = difference / n;
    const double variance = level_squares / n - level_sum / n * (level_sum / n);
    out.true_deviation_levels = std::sqrt(std::max(0.0, variance));
    return out;
}

void ShadowEdges::add(ViewF1 result, ViewF1 truth, ViewU8x1 inside) {
    const ImageF1 mine = log_of(result), real = log_of(truth);
    const auto slope = [&](int x, int y) {
        return Direction{0.25 * (real.row(y)[x + 2] - real.row(y)[x - 2]),
                         0.25 * (real.row(y + 2)[x] - real.row(y - 2)[x])};
    };
    const int margin = kProfileReach + kBeside + 3;
    for (int y = margin; y < real.height() - margin; y += kStep) {
        for (int x = margin; x < real.width() - margin; ++x) {
            if (inside.row(y)[x] != 255) continue;
            const Direction g = slope(x, y);
            const double steep = std::hypot(g.x, g.y);
            if (steep < kLeastSlope) continue;
            const Direction d{g.x / steep, g.y / steep};
            // Rows are tried every few px; on each row only the middle of an edge counts.
            if (std::abs(d.x) < 0.7) continue;
            bool greatest = true;
            for (int k = -kAcross; k <= kAcross && greatest; ++k) {
                const Direction other = slope(x + k, y);
                const double there = std::hypot(other.x, other.y);
                greatest = there < steep || (there == steep && k >= 0);
            }
            if (!greatest) continue;
            Profile a, b;
            if (!profile_at(real, inside, x, y, d, a) || !profile_at(mine, inside, x, y, d, b))
                continue;
            const auto true_edge = edge_of(a);
            if (!true_edge || std::abs(a.back() - a.front()) < kLeastStep) continue;
            ++found_;
            const auto edge = edge_of(b);
            if (!edge) continue;
            ratios_.push_back(edge->width / true_edge->width);
            lags_.push_back(std::abs(edge->middle - true_edge->middle));
        }
    }
}

ShadowEdges::Summary ShadowEdges::summary() const {
    Summary out;
    out.edges = found_;
    out.width_ratio = median(ratios_, 0.5);
    out.lag_px = median(lags_, 0.5);
    out.lag_p90_px = median(lags_, 0.9);
    if (found_ > 0)
        out.missing_share = 1.0 - static_cast<double>(ratios_.size()) / static_cast<double>(found_);
    return out;
}

}  // namespace weft
