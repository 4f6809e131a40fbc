#include "engine/synthesis/sample_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace weft {
namespace {

constexpr int kGrid = 16;  // Large areas: a sixteenth of each side.
constexpr int kMargin = 2;
// Of 144 photographs of materials, their middle 96 px: the lowest border is 0.17, the highest
// radial share 0.48, and three are more uneven: sky and lava.
constexpr double kPlainBorder = 0.12, kRadial = 0.5, kFall = 1, kUneven = 0.28;

// Sums of one area, for the mean and the variance of its colours.
struct Sums {
    std::array<double, 3> sum{}, squares{};
    double n = 0;

    void add(const std::uint8_t* p) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double v = p[c];
            sum[c] += v, squares[c] += v * v;
        }
        ++n;
    }
    void add(const Sums& o) {
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += o.sum[c], squares[c] += o.squares[c];
        n += o.n;
    }
    [[nodiscard]] std::array<double, 3> mean() const {
        return {sum[0] / n, sum[1] / n, sum[2] / n};
    }
    [[nodiscard]] double variance() const {
        double out = 0;
        for (std::size_t c = 0; c < 3; ++c)
            out += squares[c] / n - (sum[c] / n) * (sum[c] / n);
        return out;
    }
};

double distance2(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    double out = 0;
    for (std::size_t c = 0; c < 3; ++c)
        out += (a[c] - b[c]) * (a[c] - b[c]);
    return out;
}

using Areas = std::array<Sums, kGrid * kGrid>;

std::size_t index_of(int i, int j) {
    return static_cast<std::size_t>(j) * kGrid + static_cast<std::size_t>(i);
}

Areas areas_of(ViewU8x3 sample) {
    Areas out;
    for (int y = 0; y < sample.height(); ++y) {
        for (int x = 0; x < sample.width(); ++x) {
            const int i = x * kGrid / sample.width(), j = y * kGrid / sample.height();
            out[index_of(i, j)].add(sample.pixel(x, y));
        }
    }
    return out;
}

template <class Holds>
Sums of(const Areas& areas, const Holds& holds) {
    Sums out;
    for (int j = 0; j < kGrid; ++j) {
        for (int i = 0; i < kGrid; ++i)
            if (holds(i, j)) out.add(areas[index_of(i, j)]);
    }
    return out;
}

// Of the areas' luma: how much of its variance a parabola of the distance from the middle explains.
void measure_fall(const Areas& areas, double deviation, SampleDescription& out) {
    double n = 0, r = 0, v = 0, rr = 0, rv = 0, vv = 0;
    std::array<double, 4> corners{};
    double middle = 0;
    for (int j = 0; j < kGrid; ++j) {
        for (int i = 0; i < kGrid; ++i) {
            const auto mean = areas[index_of(i, j)].mean();
            const double value = (mean[0] + mean[1] + mean[2]) / 3;
            const double x = i - (kGrid - 1) / 2.0, y = j - (kGrid - 1) / 2.0;
            const double d = x * x + y * y;
            n += 1, r += d, v += value, rr += d * d, rv += d * value, vv += value * value;
            constexpr int kCorner = kGrid / 4;
            const bool left = i < kCorner, right = i >= kGrid - kCorner;
            const bool top = j < kCorner, bottom = j >= kGrid - kCorner;
            if ((left || right) && (top || bottom))
                corners[(right ? 1U : 0U) + (bottom ? 2U : 0U)] += value / (kCorner * kCorner);
            if (std::abs(x) < kCorner / 2.0 && std::abs(y) < kCorner / 2.0)
                middle += value / (kCorner * kCorner);
        }
    }
    const double cov = rv - r * v / n, var_r = rr - r * r / n, var_v = vv - v * v / n;
    out.radial = var_v > 1e-9 ? cov * cov / (var_r * var_v) : 0;
    const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
    const double fall = std::max(middle - *most, *least - middle);
    out.fall = std::max(0.0, fall) / std::max(deviation, 1e-3);
}

}  // namespace

SampleDescription describe_sample(ViewU8x3 sample) {
    SampleDescription out;
    if (std::min(sample.width(), sample.height()) < kGrid) return out;
    const Areas areas = areas_of(sample);
    const Sums all = of(areas, [](int, int) { return true; });
    const auto in_margin = [](int i, int j) {
        return std::min(i, j) < kMargin || std::max(i, j) >= kGrid - kMargin;
    };
    const Sums outer = of(areas, in_margin);
    const Sums inner = of(areas, [&](int i, int j) { return !in_margin(i, j); });
    out.border = outer.variance() / std::max(inner.variance(), 1e-3);
    measure_fall(areas, std::sqrt(all.variance() / 3), out);
    double between = 0;
    for (const int j : {0, 1}) {
        for (const int i : {0, 1}) {
            const Sums quarter = of(
                areas, [=](int x, int y) { return x / (kGrid / 2) == i && y / (kGrid / 2) == j; });
            between += distance2(quarter.mean(), all.mean()) / 4;
        }
    }
    out.uneven = between / std::max(all.variance(), 1e-3);
    out.lattice = find_lattice(sample);
    if (out.lattice.count > 0) {
        out.kind = SampleKind::kPeriodic;
    } else if (out.border < kPlainBorder || (out.radial > kRadial && out.fall > kFall) ||
               out.uneven > kUneven) {
        out.kind = SampleKind::kPicture;
    }
    return out;
}

const char* kind_name(SampleKind kind) {
    return kind == SampleKind::kPeriodic  ? "periodic"
           : kind == SampleKind::kPicture ? "picture"
                                          : "stochastic";
}

namespace {

// "26.0 px across", "17.8 px down", or with its angle above the rows.
std::string step_in_words(glm::dvec2 step) {
    constexpr double kStraight_deg = 2, kHalfTurn_deg = 180, kQuarter_deg = 90;
    double angle = std::atan2(-step.y, step.x) * kHalfTurn_deg / std::numbers::pi;
    if (angle < 0) angle += kHalfTurn_deg;
    const double length = std::hypot(step.x, step.y);
    if (std::min(angle, kHalfTurn_deg - angle) < kStraight_deg)
        return fmt::format("{:.1f} px across", length);
    if (std::abs(angle - kQuarter_deg) < kStraight_deg)
        return fmt::format("{:.1f} px down", length);
    return fmt::format("{:.1f} px at {:.0f}°", length, angle);
}

}  // namespace

std::string reason_of(const SampleDescription& sample) {
    const SampleLattice& l = sample.lattice;
    const auto percent = [](double share) { return std::lround(100 * share); };
    switch (sample.kind) {
        case SampleKind::kPeriodic:
            if (l.count == 1)
                return fmt::format("its stripes, {:.1f} px apart, are kept in step",
                                   std::hypot(l.steps[0].x, l.steps[0].y));
            return fmt::format("its units are kept whole, every {} and every {}",
                               step_in_words(l.steps[0]), step_in_words(l.steps[1]));
        case SampleKind::kPicture:
            if (sample.border < kPlainBorder)
                return fmt::format("a plain border, with {} % of the variance inside it",
                                   percent(sample.border));
            if (sample.uneven > kUneven)
                return fmt::format("its quarters differ by {} % of its variance",
                                   percent(sample.uneven));
            return fmt::format("its corners differ from its middle by {:.1f} standard deviations",
                               sample.fall);
        default:
            return "no unit repeats, so patches are laid freely";
    }
}

}  // namespace weft
