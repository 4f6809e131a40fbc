#include "engine/motion/plane_fit.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <opencv2/core.hpp>

namespace weft {
namespace {

constexpr int kTerms = 8;
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

// The weighted normal equations of what departs from no motion, in normalised places.
class Equations {
  public:
    explicit Equations(const std::vector<PlacePair>& pairs)
        : pairs_(pairs), from_(pairs, &PlacePair::from), to_(pairs, &PlacePair::to) {}

    [[nodiscard]] glm::dvec2 mean_displacement() const { return to_.middle - from_.middle; }

    void set(const std::vector<double>& weights) {
        a_ = {};
        b_ = {};
        total_ = 0;
        for (std::size_t k = 0; k < pairs_.size(); ++k) {
            const glm::dvec2 p = from_.of(pairs_[k].from), q = to_.of(pairs_[k].to);
            const double w = weights[k];
            add({0, 1, 2, 6, 7}, {p.x, p.y, 1, -q.x * p.x, -q.x * p.y}, q.x - p.x, w);
            add({3, 4, 5, 6, 7}, {p.x, p.y, 1, -q.y * p.x, -q.y * p.y}, q.y - p.y, w);
            total_ += w;
        }
    }
    // Draws terms towards 0, for each unit of weight.
    void draw(double affine, double perspective) {
        for (int k = 0; k < kTerms; ++k)
            a_(k, k) += total_ * (k < 6 ? affine : perspective);
    }
    // False if places on a line, or too few, leave terms open.
    [[nodiscard]] bool determined() const {
        cv::Matx<double, kTerms, kTerms> both = a_;
        for (int i = 0; i < kTerms; ++i)
            for (int j = 0; j < i; ++j)
                both(j, i) = a_(i, j);
        cv::Vec<double, kTerms> values;
        return cv::eigen(both, values) && values[kTerms - 1] > 1e-12 * values[0];
    }
    // In pixels; empty if there is no solution.
    [[nodiscard]] std::optional<glm::dmat3> solved() const {
        cv::Vec<double, kTerms> h;
        if (!cv::solve(a_, b_, h, cv::DECOMP_CHOLESKY)) return std::nullopt;
        const glm::dmat3 normalised{
            {1 + h[0], h[3], h[6]}, {h[1], 1 + h[4], h[7]}, {h[2], h[5], 1}};
        return glm::inverse(to_.matrix()) * normalised * from_.matrix();
    }

  private:
    // A row that is 0 in all but five terms. Only the lower half is filled: Cholesky reads no more.
    void add(const std::array<int, 5>& terms, const std::array<double, 5>& row, double value,
             double weight) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            const double weighted = weight * row[i];
            for (std::size_t j = 0; j <= i; ++j)
                a_(terms[i], terms[j]) += weighted * row[j];
            b_[terms[i]] += weight * value * row[i];
        }
    }

    const std::vector<PlacePair>& pairs_;
    Centred from_, to_;
    cv::Matx<double, kTerms, kTerms> a_;
    cv::Vec<double, kTerms> b_;
    double total_ = 0;
};

template <class Value>
Value median_of(std::vector<Value> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

glm::dvec2 median_displacement(const std::vector<PlacePair>& pairs) {
    std::vector<float> x, y;
    x.reserve(pairs.size());
    y.reserve(pairs.size());
    for (const PlacePair& pair : pairs) {
        x.push_back(pair.to.x - pair.from.x);
        y.push_back(pair.to.y - pair.from.y);
    }
    return {median_of(std::move(x)), median_of(std::move(y))};
}

// Cauchy weights for how far each pair is off.
std::vector<double> weights_under(const glm::dmat3& plane, const std::vector<PlacePair>& pairs) {
    std::vector<double> misses(pairs.size());
    for (std::size_t k = 0; k < pairs.size(); ++k)
        misses[k] = static_cast<double>(glm::length(mapped(plane, pairs[k].from) - pairs[k].to));
    const double scale = 1.5 * std::max(median_of(misses), kLeastScale_px);
    for (double& miss : misses)
        miss = 1 / (1 + miss * miss / (scale * scale));
    return misses;
}

}  // namespace

Vec2 mapped(const glm::dmat3& plane, Vec2 p) {
    const glm::dvec3 q = plane * glm::dvec3(p, 1);
    return {static_cast<float>(q.x / q.z), static_cast<float>(q.y / q.z)};
}

Vec2 moved_by(const glm::dmat3& plane, Vec2 p) {
    const glm::dvec3 q = plane * glm::dvec3(p, 1);
    return Vec2(glm::dvec2(q) / q.z - glm::dvec2(p));
}

double nearest_depth(std::vector<double> depths) {
    constexpr double kOfLeast = 0.5, kOfMedian = 0.05;
    if (depths.empty()) return 1;
    const double least = *std::min_element(depths.begin(), depths.end());
    return std::max(kOfLeast * least, kOfMedian * median_of(std::move(depths)));
}

glm::dmat3 fit_plane(const std::vector<PlacePair>& pairs, const PlaneFitOptions& options) {
    // (0.005 / 0.3)²: noise of the places against how much a plane's perspective varies.
    constexpr double kTowardsAffine = 3e-4, kTowardsNone = 1e-6;
    if (pairs.empty()) return glm::dmat3(1);
    Equations equations(pairs);
    glm::dmat3 plane =
        shifted(options.from_median ? median_displacement(pairs) : equations.mean_displacement());
    if (pairs.size() < std::max<std::size_t>(kTerms, options.fewest)) return plane;
    std::vector<double> weights =
        options.from_median ? weights_under(plane, pairs) : std::vector<double>(pairs.size(), 1.0);
    for (int round = 0; round < options.rounds; ++round) {
        if (round > 0) weights = weights_under(plane, pairs);
        equations.set(weights);
        equations.draw(kTowardsNone, kTowardsAffine);
        const std::optional<glm::dmat3> fit = equations.solved();
        if (!fit) return plane;
        plane = *fit;
    }
    return plane;
}

std::optional<glm::dmat3> fit_homography(const std::vector<PlacePair>& pairs) {
    if (pairs.size() < 4) return std::nullopt;
    Equations equations(pairs);
    equations.set(std::vector<double>(pairs.size(), 1.0));
    return equations.determined() ? equations.solved() : std::nullopt;
}

}  // namespace weft
