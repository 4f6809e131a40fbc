#include "engine/motion/plane_fit.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <opencv2/core.hpp>

namespace weft {
namespace {

constexpr int kTerms = 8, kRounds = 15;
constexpr double kLeastScale_px = 0.1;

// To the middle of the points, and to a mean distance of 1 from it.
struct Centred {
    glm::dvec2 middle{0};
    double scale = 1;

    explicit Centred(const std::vector<PlacePair>& pairs, Vec2 PlacePair::*which) {
        const double n = static_cast<double>(pairs.size());
        for (const PlacePair& pair : pairs)
            middle += glm::dvec2(pair.*which) / n;
        double distance = 0;
        for (const PlacePair& pair : pairs)
            distance += glm::length(glm::dvec2(pair.*which) - middle) / n;
        scale = 1 / std::max(1e-6, distance);
    }
    [[nodiscard]] glm::dvec2 of(Vec2 p) const { return (glm::dvec2(p) - middle) * scale; }
    // Columns, as GLM has them.
    [[nodiscard]] glm::dmat3 matrix() const {
        return {{scale, 0, 0}, {0, scale, 0}, {-middle.x * scale, -middle.y * scale, 1}};
    }
};

glm::dmat3 shifted(glm::dvec2 by) {
    return {{1, 0, 0}, {0, 1, 0}, {by.x, by.y, 1}};
}

// One weighted solution, in normalised places: what departs from no motion there; what the pairs
// leave open does not. False if there is none.
bool solve(const std::vector<PlacePair>& pairs, const std::vector<double>& weights,
           const Centred& from, const Centred& to, glm::dmat3& out) {
    // (0.005 / 0.3)²: noise of the places against how much a plane's perspective varies.
    constexpr double kTowardsAffine = 3e-4, kTowardsNone = 1e-6;
    cv::Matx<double, kTerms, kTerms> a;
    cv::Vec<double, kTerms> b;
    double total = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const glm::dvec2 p = from.of(pairs[k].from), q = to.of(pairs[k].to);
        const std::array<cv::Vec<double, kTerms>, 2> rows{
            {{p.x, p.y, 1, 0, 0, 0, -q.x * p.x, -q.x * p.y},
             {0, 0, 0, p.x, p.y, 1, -q.y * p.x, -q.y * p.y}}};
        const std::array<double, 2> values{q.x - p.x, q.y - p.y};
        for (std::size_t r = 0; r < 2; ++r) {
            a += weights[k] * rows[r] * rows[r].t();
            b += weights[k] * values[r] * rows[r];
        }
        total += weights[k];
    }
    for (int k = 0; k < kTerms; ++k)
        a(k, k) += total * (k < 6 ? kTowardsNone : kTowardsAffine);
    cv::Vec<double, kTerms> h;
    if (!cv::solve(a, b, h, cv::DECOMP_CHOLESKY)) return false;
    out = {{1 + h[0], h[3], h[6]}, {h[1], 1 + h[4], h[7]}, {h[2], h[5], 1}};
    return true;
}

}  // namespace

Vec2 mapped(const glm::dmat3& plane, Vec2 p) {
    const glm::dvec3 q = plane * glm::dvec3(p, 1);
    return {static_cast<float>(q.x / q.z), static_cast<float>(q.y / q.z)};
}

glm::dmat3 fit_plane(const std::vector<PlacePair>& pairs) {
    if (pairs.empty()) return glm::dmat3(1);
    const Centred from(pairs, &PlacePair::from), to(pairs, &PlacePair::to);
    glm::dmat3 plane = shifted(to.middle - from.middle);
    if (pairs.size() < kTerms) return plane;
    std::vector<double> weights(pairs.size(), 1.0), misses(pairs.size());
    for (int round = 0; round < kRounds; ++round) {
        glm::dmat3 normalised;
        if (!solve(pairs, weights, from, to, normalised)) return plane;
        plane = glm::inverse(to.matrix()) * normalised * from.matrix();
        for (std::size_t k = 0; k < pairs.size(); ++k)
            misses[k] =
                static_cast<double>(glm::length(mapped(plane, pairs[k].from) - pairs[k].to));
        std::vector<double> sorted = misses;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        const double scale = 1.5 * std::max(*middle, kLeastScale_px);
        for (std::size_t k = 0; k < pairs.size(); ++k)
            weights[k] = 1 / (1 + misses[k] * misses[k] / (scale * scale));
    }
    return plane;
}

}  // namespace weft
