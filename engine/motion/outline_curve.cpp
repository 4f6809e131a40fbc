#include "engine/motion/outline_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "engine/motion/view_mat.h"

namespace weft {
namespace {

constexpr int kPoints = 180;

// Means over the neighbours along a closed curve: a contour of pixels is a staircase.
std::vector<Vec2> smoothed(const std::vector<cv::Point>& contour) {
    constexpr int kReach = 2;
    const auto n = static_cast<int>(contour.size());
    std::vector<Vec2> out;
    out.reserve(contour.size());
    for (int k = 0; k < n; ++k) {
        Vec2 sum(0);
        for (int j = -kReach; j <= kReach; ++j) {
            const cv::Point& p = contour[static_cast<std::size_t>((k + j + n) % n)];
            sum += Vec2(static_cast<float>(p.x) + 0.5f, static_cast<float>(p.y) + 0.5f);
        }
        out.push_back(sum / static_cast<float>(2 * kReach + 1));
    }
    return out;
}

// How a curve goes on around each point, whatever its direction: the tangent some way ahead as seen
// from the one as far behind. Not from far: waves travel through cloth, corners stay.
constexpr std::array<int, 2> kReaches{2, 4};  // points
using Bend = std::array<Vec2, kReaches.size()>;

std::vector<Bend> bends_of(const std::vector<Vec2>& p) {
    const auto n = static_cast<int>(p.size());
    const auto at = [&](int k) { return p[static_cast<std::size_t>((k + 2 * n) % n)]; };
    const auto direction = [&](int from, int to) {
        const Vec2 d = at(to) - at(from);
        const float length = glm::length(d);
        return length > 0 ? d / length : Vec2(1, 0);
    };
    std::vector<Bend> out(p.size());
    for (int k = 0; k < n; ++k) {
        for (std::size_t r = 0; r < kReaches.size(); ++r) {
            const Vec2 before = direction(k - kReaches[r], k),
                       after = direction(k, k + kReaches[r]);
            out[static_cast<std::size_t>(k)][r] = {glm::dot(before, after),
                                                   before.x * after.y - before.y * after.x};
        }
    }
    return out;
}

// 0 to 4: 2 for a right angle on a straight line.
float bend_difference(const Bend& a, const Bend& b) {
    float sum = 0;
    for (std::size_t r = 0; r < kReaches.size(); ++r)
        sum += glm::dot(a[r] - b[r], a[r] - b[r]);
    return sum / static_cast<float>(kReaches.size());
}

// The costs of all pairs of points: row by point of `cur`, column by point of `prev`.
std::vector<float> costs_of(const OutlineCurve& prev, const OutlineCurve& cur,
                            const LatticeField& prev_from_cur) {
    constexpr float kPlace = 0.15f;  // of a distance of the shape's size, against a right angle
    const std::size_t n = cur.p.size(), m = prev.p.size();
    const std::vector<Bend> here = bends_of(cur.p), there = bends_of(prev.p);
    const float size = prev.step_px * static_cast<float>(m) / 4;
    std::vector<float> out(n * m);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 moved = cur.p[i] + prev_from_cur.at(cur.p[i]);
        for (std::size_t j = 0; j < m; ++j) {
            const Vec2 away = (prev.p[j] - moved) / size;
            out[i * m + j] = kPlace * glm::dot(away, away) + bend_difference(here[i], there[j]);
        }
    }
    return out;
}

// Steps along both curves, and what stretching costs.
struct Step {
    int cur, prev;
    float cost;
};
constexpr std::array<Step, 5> kSteps{
    {{1, 1, 0}, {1, 2, 0.3f}, {2, 1, 0.3f}, {1, 3, 0.7f}, {3, 1, 0.7f}}};

// The cheapest way once around both curves that begins at `cur`'s point 0 and `prev`'s point
// `first`: its cost, and if `path` is not null its pairs of points.
float way_around(const std::vector<float>& costs, int n, int m, int first,
                 std::vector<std::array<int, 2>>* path) {
    constexpr float kNever = std::numeric_limits<float>::infinity();
    const auto at = [m](int i, int j) {
        return static_cast<std::size_t>(i) * static_cast<std::size_t>(m + 1) +
               static_cast<std::size_t>(j);
    };
    std::vector<float> best(static_cast<std::size_t>(n + 1) * static_cast<std::size_t>(m + 1),
                            kNever);
    std::vector<std::uint8_t> from(best.size());
    best[0] = 0;
    for (int i = 1; i <= n; ++i) {
        // The whole ways are as long, so a point lies near to the diagonal.
        const int middle = i * m / n, reach = m / 5;
        for (int j = std::max(1, middle - reach); j <= std::min(m, middle + reach); ++j) {
            const int pair = (i % n) * m + (j + first) % m;
            const float own = costs[static_cast<std::size_t>(pair)];
            for (std::size_t s = 0; s < kSteps.size(); ++s) {
                const Step& step = kSteps[s];
                if (i < step.cur || j < step.prev) continue;
                // A longer step passes as much more of the curves.
                const float more = static_cast<float>(std::max(step.cur, step.prev)) * own;
                const float sum = best[at(i - step.cur, j - step.prev)] + more + step.cost;
                if (sum < best[at(i, j)]) {
                    best[at(i, j)] = sum;
                    from[at(i, j)] = static_cast<std::uint8_t>(s);
                }
            }
        }
    }
    if (path && best[at(n, m)] < kNever) {
        for (int i = n, j = m; i > 0 || j > 0;) {
            path->push_back({i % n, (j + first) % m});
            const Step& step = kSteps[from[at(i, j)]];
            i -= step.cur, j -= step.prev;
        }
    }
    return best[at(n, m)];
}

}  // namespace

OutlineCurve outline_curve(ViewU8x1 extent) {
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(as_mat(extent) >= 128, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    const auto largest = std::max_element(
        contours.begin(), contours.end(),
        [](const auto& a, const auto& b) { return cv::contourArea(a) < cv::contourArea(b); });
    OutlineCurve out;
    constexpr std::size_t kLeast = 40;  // pixels
    if (largest == contours.end() || largest->size() < kLeast) return out;
    const std::vector<Vec2> p = smoothed(*largest);
    std::vector<float> length(p.size() + 1);
    for (std::size_t k = 0; k < p.size(); ++k)
        length[k + 1] = length[k] + glm::length(p[(k + 1) % p.size()] - p[k]);
    out.step_px = length.back() / static_cast<float>(kPoints);
    std::size_t k = 0;
    for (int s = 0; s < kPoints; ++s) {
        const float goal = out.step_px * static_cast<float>(s);
        while (k + 1 < p.size() && length[k + 1] <= goal)
            ++k;
        const float part = (goal - length[k]) / std::max(1e-6f, length[k + 1] - length[k]);
        const Vec2 at = glm::mix(p[k], p[(k + 1) % p.size()], std::clamp(part, 0.0f, 1.0f));
        const float border = std::min({at.x, at.y, static_cast<float>(extent.width()) - at.x,
                                       static_cast<float>(extent.height()) - at.y});
        out.p.push_back(at);
        out.cut.push_back(border < 1.5f ? 1 : 0);
    }
    return out;
}

std::vector<OutlinePair> match_outlines(const OutlineCurve& prev, const OutlineCurve& cur,
                                        const LatticeField& prev_from_cur) {
    constexpr int kStarts = 36, kMostCut = kPoints / 10;
    const auto whole = [](const OutlineCurve& c) {
        return !c.p.empty() && std::count(c.cut.begin(), c.cut.end(), 1) <= kMostCut;
    };
    if (!whole(prev) || !whole(cur)) return {};
    const std::vector<float> costs = costs_of(prev, cur, prev_from_cur);
    int first = 0;
    float least = std::numeric_limits<float>::infinity();
    for (int k = 0; k < kStarts; ++k) {
        const int start = k * kPoints / kStarts;
        const float cost = way_around(costs, kPoints, kPoints, start, nullptr);
        if (cost < least) least = cost, first = start;
    }
    const int near = first;
    for (int start = near - kPoints / kStarts + 1; start < near + kPoints / kStarts; ++start) {
        const int s = (start + kPoints) % kPoints;
        const float cost = way_around(costs, kPoints, kPoints, s, nullptr);
        if (cost < least) least = cost, first = s;
    }
    std::vector<std::array<int, 2>> path;
    way_around(costs, kPoints, kPoints, first, &path);
    std::vector<OutlinePair> out;
    for (const auto& [i, j] : path) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        if (cur.cut[a] == 0 && prev.cut[b] == 0) out.push_back({cur.p[a], prev.p[b]});
    }
    return out;
}

double outline_slip(const OutlineCurve& prev, const OutlineCurve& cur,
                    const LatticeField& prev_from_cur) {
    if (prev.p.empty() || cur.p.empty()) return 1;
    constexpr double kStretch = 0.3;  // as kSteps: a point more or less
    constexpr double kMost = 0.7;
    const std::vector<Bend> here = bends_of(cur.p), there = bends_of(prev.p);
    const auto m = static_cast<int>(prev.p.size());
    std::vector<int> nearest;
    for (const Vec2& p : cur.p) {
        const Vec2 moved = p + prev_from_cur.at(p);
        const auto closest =
            std::min_element(prev.p.begin(), prev.p.end(), [&](const Vec2& a, const Vec2& b) {
                return glm::dot(a - moved, a - moved) < glm::dot(b - moved, b - moved);
            });
        nearest.push_back(static_cast<int>(closest - prev.p.begin()));
    }
    // Over a few points, since a nearest point is right to one of them.
    constexpr int kApart = 5;
    double sum = 0;
    for (std::size_t i = 0; i < cur.p.size(); ++i) {
        const int j = nearest[i];
        const int further = nearest[(i + kApart) % cur.p.size()];
        const int went = ((further - j) % m + m + m / 2) % m - m / 2;
        sum += bend_difference(here[i], there[static_cast<std::size_t>(j)]);
        sum += std::min(kMost, kStretch * std::abs(went - kApart) / kApart);
    }
    return sum / static_cast<double>(cur.p.size());
}

}  // namespace weft
