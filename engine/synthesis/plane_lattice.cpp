#include "engine/synthesis/plane_lattice.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numeric>

namespace weft {
namespace {

constexpr double kRounding_px = 0.75;  // No point of the plane is farther from a texel: √½.
constexpr double kLargestTolerance_px = 2;
constexpr double kExactStrain = 0.0025;

double to_whole(double v) {
    return v - std::round(v);
}

// How far the lattice moves per pixel along x (or y) if that side is made a whole number of
// periods: the nearest whole turns of every wave, in pixels.
double strain_along(const LatticeWaves& waves, const std::array<glm::dvec2, 2>& steps, int count,
                    int axis, int side) {
    glm::dvec2 move{0};
    for (int k = 0; k < count; ++k) {
        const auto i = static_cast<std::size_t>(k);
        move += to_whole(waves[i][axis] * side) / side * steps[i];
    }
    return glm::length(move);
}

int whole_side(const SampleLattice& lattice, int axis, int least) {
    const LatticeWaves waves = waves_of(lattice);
    const int most = std::min(least + least / 8, kLargestPlaneSide);
    int best = least;
    double best_strain = HUGE_VAL;
    for (int side = least; side <= most; ++side) {
        const double strain = strain_along(waves, lattice.steps, lattice.count, axis, side);
        if (strain < best_strain) best = side, best_strain = strain;
        if (strain <= kExactStrain) break;
    }
    return best;
}

}  // namespace

PlaneLattice::PlaneLattice(const SampleLattice& sample, std::optional<Size> torus)
    : count_(sample.count),
      waves_(waves_of(sample)),
      steps_(sample.steps),
      tolerance_px_(std::clamp(sample.residual_px, kRounding_px, kLargestTolerance_px)) {
    if (!torus || count_ == 0) return;
    const int sides[2] = {torus->width, torus->height};
    for (int axis = 0; axis < 2; ++axis) {
        strain_ = std::max(strain_, strain_along(waves_, steps_, count_, axis, sides[axis]));
        for (int k = 0; k < count_; ++k) {
            double& turns = waves_[static_cast<std::size_t>(k)][axis];
            turns = std::round(turns * sides[axis]) / sides[axis];
        }
    }
    steps_ = steps_of(waves_, count_);
    if (count_ < 2) return;
    steps_ = reduced(steps_);
    SampleLattice strained;
    strained.count = 2, strained.steps = steps_;
    waves_ = waves_of(strained);
}

glm::dvec2 PlaneLattice::miss(glm::dvec2 offset) const {
    if (count_ == 0) return glm::dvec2{0};
    if (count_ == 1) return to_whole(glm::dot(waves_[0], offset)) * steps_[0];
    const double a = glm::dot(waves_[0], offset), b = glm::dot(waves_[1], offset);
    // The nearest point is one of the cell's corners, because the steps are reduced.
    glm::dvec2 best{HUGE_VAL};
    for (const double i : {std::floor(a), std::ceil(a)}) {
        for (const double j : {std::floor(b), std::ceil(b)}) {
            const glm::dvec2 d = offset - i * steps_[0] - j * steps_[1];
            if (glm::dot(d, d) < glm::dot(best, best)) best = d;
        }
    }
    return best;
}

bool PlaneLattice::holds(Vec2i offset) const {
    return count_ == 0 || held(offset, {1, 1}).at(0, 0) != 0;
}

Image<std::uint8_t, 1> PlaneLattice::held(Vec2i first, Size size) const {
    Image<std::uint8_t, 1> out(size, 0);
    if (count_ < 2) {
        const double turns = count_ == 0 ? HUGE_VAL : tolerance_px_ / glm::length(steps_[0]);
        for (int y = 0; y < size.height; ++y) {
            const double start = glm::dot(waves_[0], glm::dvec2(first + Vec2i{0, y}));
            for (int x = 0; x < size.width; ++x)
                out.at(x, y) = std::abs(to_whole(start + waves_[0].x * x)) <= turns;
        }
        return out;
    }
    const double most = tolerance_px_ * tolerance_px_;
    const auto test = [&](int x, int y) {
        const glm::dvec2 d = miss(glm::dvec2(first + Vec2i{x, y}));
        if (glm::dot(d, d) <= most) out.at(x, y) = 1;
    };
    // The texels around the lattice's points, which are few.
    const int reach = static_cast<int>(std::ceil(tolerance_px_));
    double a0 = HUGE_VAL, a1 = -HUGE_VAL, b0 = HUGE_VAL, b1 = -HUGE_VAL;
    for (const int x : {first.x - reach, first.x + size.width + reach}) {
        for (const int y : {first.y - reach, first.y + size.height + reach}) {
            const glm::dvec2 p{x, y};
            const double a = glm::dot(waves_[0], p), b = glm::dot(waves_[1], p);
            a0 = std::min(a0, a), a1 = std::max(a1, a), b0 = std::min(b0, b), b1 = std::max(b1, b);
        }
    }
    const auto below = [](double v) { return static_cast<int>(std::floor(v)); };
    for (int i = below(a0); i <= below(a1) + 1; ++i) {
        for (int j = below(b0); j <= below(b1) + 1; ++j) {
            const glm::dvec2 p =
                static_cast<double>(i) * steps_[0] + static_cast<double>(j) * steps_[1];
            const int cx = static_cast<int>(std::lround(p.x)) - first.x;
            const int cy = static_cast<int>(std::lround(p.y)) - first.y;
            for (int y = std::max(0, cy - reach); y <= std::min(size.height - 1, cy + reach); ++y)
                for (int x = std::max(0, cx - reach); x <= std::min(size.width - 1, cx + reach);
                     ++x)
                    test(x, y);
        }
    }
    return out;
}

// The lattice's points lie on lines along any step u. A rectangle as wide as u meets a point of
// every line that crosses it; as high as the lines' distance and their rise, it is crossed.
std::vector<Size> PlaneLattice::covers() const {
    std::vector<Size> out;
    const auto up = [](double v) { return static_cast<int>(std::ceil(v)) + 1; };
    if (count_ == 1) {
        if (waves_[0].x != 0) out.push_back({up(1 / std::abs(waves_[0].x)), 0});
        if (waves_[0].y != 0) out.push_back({0, up(1 / std::abs(waves_[0].y))});
    }
    if (count_ < 2) return out;
    const double area = std::abs(steps_[0].x * steps_[1].y - steps_[0].y * steps_[1].x);
    for (int i = -3; i <= 3; ++i) {
        for (int j = 0; j <= 3; ++j) {
            const glm::dvec2 u =
                static_cast<double>(i) * steps_[0] + static_cast<double>(j) * steps_[1];
            const double w = std::abs(u.x), h = std::abs(u.y);
            if ((j == 0 && i <= 0) || std::gcd(i, j) != 1) continue;
            if (w >= 1) out.push_back({up(w), up(area / w + h)});
            if (h >= 1) out.push_back({up(area / h + w), up(h)});
        }
    }
    return out;
}

Size whole_periods(const SampleLattice& lattice, Size least) {
    if (lattice.count == 0) return least;
    return {whole_side(lattice, 0, least.width), whole_side(lattice, 1, least.height)};
}

}  // namespace weft
