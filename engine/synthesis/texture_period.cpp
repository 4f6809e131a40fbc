// The mean squared difference between the sample and itself moved by d, for all d at once, over
// twice the variance: near 1 for unrelated pixels, low where the texture repeats.

#include "engine/synthesis/texture_period.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "engine/synthesis/fft_correlation.h"

namespace weft {
namespace {

constexpr int kLargest = 256;
constexpr int kLeastStep = 8;
// Real courses of bricks and tiles reach 0.15 to 0.4; gravel, grass and bark stay above 0.75.
constexpr double kRepeats = 0.45;
constexpr double kAsGood = 0.12;
constexpr int kBorder = 2;

struct Candidate {
    Vec2i step;
    double mismatch;
};

double length(Vec2i v) {
    return std::hypot(static_cast<double>(v.x), static_cast<double>(v.y));
}

double dot(Vec2i a, Vec2i b) {
    return static_cast<double>(a.x) * b.x + static_cast<double>(a.y) * b.y;
}

double cross(Vec2i a, Vec2i b) {
    return static_cast<double>(a.x) * b.y - static_cast<double>(a.y) * b.x;
}

// d as a multiple of each of two steps.
std::pair<double, double> in_steps(const std::array<Vec2i, 2>& steps, Vec2i d) {
    const double det = cross(steps[0], steps[1]);
    return {cross(d, steps[1]) / det, cross(steps[0], d) / det};
}

// |sin| of the angle between.
double apart(Vec2i a, Vec2i b) {
    return std::abs(cross(a, b)) / (length(a) * length(b));
}

double variance(ViewU8x3 s) {
    std::array<double, 3> sum{}, squares{};
    for (int y = 0; y < s.height(); ++y) {
        for (int x = 0; x < s.width(); ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                const double v = s.pixel(x, y)[c];
                sum[c] += v, squares[c] += v * v;
            }
        }
    }
    const double n = static_cast<double>(s.width()) * s.height();
    double out = 0;
    for (std::size_t c = 0; c < 3; ++c)
        out += squares[c] / n - (sum[c] / n) * (sum[c] / n);
    return out;
}

// Mismatches of the moves d with |dx| ≤ reach.x, 0 ≤ dy ≤ reach.y.
Image<double, 1> mismatch_of(ViewU8x3 s, Vec2i reach) {
    const FftCorrelation correlation(s, s.size(), {-reach.x, 0}, reach);
    const Image<std::uint8_t, 1> all(s.size(), 1);
    const auto estimate = correlation.estimate({s, all, {}, {}, 1, 0});
    const double unrelated = std::max(2 * variance(s), 1.0);
    Image<double, 1> out(2 * reach.x + 1, reach.y + 1);
    for (std::size_t i = 0; i < estimate.ssd.size(); ++i) {
        out.data()[i] = std::max(0.0, estimate.ssd[i]) /
                        static_cast<double>(std::max<std::uint64_t>(estimate.weight[i], 1)) /
                        unrelated;
    }
    return out;
}

// Moves that are better than all moves around them, and much better than what lies between them and
// the origin: the slope around the origin is not repetition.
std::vector<Candidate> local_minima(const Image<double, 1>& m, Vec2i reach) {
    std::vector<Candidate> out;
    const auto at = [&](int dx, int dy) {
        return dy < 0 ? m.at(reach.x - dx, -dy) : m.at(reach.x + dx, dy);
    };
    for (int dy = 0; dy <= reach.y - kBorder; ++dy) {
        for (int dx = -reach.x + kBorder; dx <= reach.x - kBorder; ++dx) {
            if ((dy == 0 && dx <= 0) || length({dx, dy}) < kLeastStep) continue;
            const double here = at(dx, dy);
            if (here > kRepeats) continue;
            bool least = true;
            for (int y = -kBorder; y <= kBorder && least; ++y) {
                for (int x = -kBorder; x <= kBorder; ++x)
                    least &= dy + y < -kBorder || at(dx + x, dy + y) >= here;
            }
            double ridge = 0;
            const int samples = 16;
            for (int k = 1; k < samples; ++k) {
                ridge = std::max(ridge, at(dx * k / samples, dy * k / samples));
            }
            if (least && ridge > here + 0.2) out.push_back({{dx, dy}, here});
        }
    }
    return out;
}

// Planks and stripes: along one axis all moves are alike. Takes the best local minimum on the other
// axis; empty if there is none.
std::optional<Candidate> step_across(const Image<double, 1>& m, Vec2i reach, bool along_x) {
    const auto at = [&](int along, int across) {
        return along_x ? m.at(reach.x + along, across) : m.at(reach.x + across, along);
    };
    const int far = along_x ? reach.x : reach.y;
    double least = 1, most = 0;
    for (int along = kLeastStep; along <= far; along += 2) {
        least = std::min(least, at(along, 0)), most = std::max(most, at(along, 0));
    }
    if (most > kRepeats || least < 0.6 * most) return std::nullopt;
    std::optional<Candidate> best;
    double ridge = 0;
    for (int d = 1; d + kBorder <= (along_x ? reach.y : reach.x); ++d) {
        ridge = std::max(ridge, at(0, d));
        const double here = at(0, d);
        if (d < kLeastStep || here > kRepeats || ridge < here + 0.2) continue;
        if (here > std::min(at(0, d - 1), at(0, d + 1))) continue;
        // Of nearly equal ones the shortest is the step; the others are its multiples.
        if (best && here > best->mismatch - 0.05) continue;
        best = Candidate{along_x ? Vec2i{0, d} : Vec2i{d, 0}, here};
    }
    return best;
}

}  // namespace

bool TexturePeriod::holds(Vec2i d, double tolerance_px) const {
    if (count == 0) return true;
    if (count == 1) {
        const double turns = dot(d, steps[0]) / dot(steps[0], steps[0]);
        return std::abs(turns - std::round(turns)) * length(steps[0]) <= tolerance_px;
    }
    const auto [a, b] = in_steps(steps, d);
    // The nearest lattice point is one of the cell's four corners, for the reduced steps found
    // here.
    for (const double i : {std::floor(a), std::ceil(a)}) {
        for (const double j : {std::floor(b), std::ceil(b)}) {
            const double x = d.x - i * steps[0].x - j * steps[1].x;
            const double y = d.y - i * steps[0].y - j * steps[1].y;
            if (std::hypot(x, y) <= tolerance_px) return true;
        }
    }
    return false;
}

// With two steps: the discs around the lattice's points, which are few. A test of every translation
// took longer than the search among the allowed ones.
Image<std::uint8_t, 1> TexturePeriod::held(Vec2i first, Size size, double tolerance_px) const {
    Image<std::uint8_t, 1> out(size, count == 0 ? 1 : 0);
    if (count == 1) {
        const double px = length(steps[0]), square = dot(steps[0], steps[0]);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const double turns = dot(first + Vec2i{x, y}, steps[0]) / square;
                out.at(x, y) = std::abs(turns - std::round(turns)) * px <= tolerance_px;
            }
        }
    }
    if (count < 2) return out;
    const int reach = static_cast<int>(tolerance_px);
    double least_a = HUGE_VAL, most_a = -HUGE_VAL, least_b = HUGE_VAL, most_b = -HUGE_VAL;
    for (const int x : {first.x - reach, first.x + size.width + reach}) {
        for (const int y : {first.y - reach, first.y + size.height + reach}) {
            const auto [a, b] = in_steps(steps, {x, y});
            least_a = std::min(least_a, a), most_a = std::max(most_a, a);
            least_b = std::min(least_b, b), most_b = std::max(most_b, b);
        }
    }
    const auto stamp = [&](Vec2i centre) {
        for (int dy = -reach; dy <= reach; ++dy) {
            for (int dx = -reach; dx <= reach; ++dx) {
                const Vec2i p = centre + Vec2i{dx, dy};
                if (!rect_of(size).contains(p.x, p.y)) continue;
                if (length({dx, dy}) <= tolerance_px) out.at(p.x, p.y) = 1;
            }
        }
    };
    for (int i = static_cast<int>(std::floor(least_a)); i <= static_cast<int>(most_a) + 1; ++i) {
        for (int j = static_cast<int>(std::floor(least_b)); j <= static_cast<int>(most_b) + 1; ++j)
            stamp(Vec2i{i * steps[0].x + j * steps[1].x, i * steps[0].y + j * steps[1].y} - first);
    }
    return out;
}

Size TexturePeriod::axis_px() const {
    Size out{0, 0};
    const auto take = [](int& best, int px) {
        if (px > 0 && (best == 0 || px < best)) best = px;
    };
    constexpr int kTurns = 3, kSlant = 2;
    for (int i = -kTurns; i <= kTurns; ++i) {
        for (int j = count == 2 ? -kTurns : 0; j <= (count == 2 ? kTurns : 0); ++j) {
            if (count == 0) break;
            const Vec2i d{i * steps[0].x + j * steps[1].x, i * steps[0].y + j * steps[1].y};
            if (std::abs(d.y) <= kSlant) take(out.width, std::abs(d.x));
            if (std::abs(d.x) <= kSlant) take(out.height, std::abs(d.y));
        }
    }
    return out;
}

SelfMismatch self_mismatch(ViewU8x3 sample) {
    const Size s{std::min(sample.width(), kLargest), std::min(sample.height(), kLargest)};
    const int x0 = (sample.width() - s.width) / 2, y0 = (sample.height() - s.height) / 2;
    const Vec2i reach{s.width / 2, s.height / 2};
    return {mismatch_of(sample.crop({x0, y0, x0 + s.width, y0 + s.height}), reach), reach};
}

TexturePeriod find_period(const SelfMismatch& self) {
    const Image<double, 1>& mismatch = self.mismatch;
    const Vec2i reach = self.reach;
    TexturePeriod period;
    for (const bool along_x : {true, false}) {
        if (const auto step = step_across(mismatch, reach, along_x)) {
            period.count = 1;
            period.steps[0] = step->step;
            period.mismatch = step->mismatch;
            return period;
        }
    }
    std::vector<Candidate> found = local_minima(mismatch, reach);
    if (found.empty()) return period;
    const double best =
        std::min_element(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
            return a.mismatch < b.mismatch;
        })->mismatch;
    std::erase_if(found, [&](const Candidate& c) { return c.mismatch > best + kAsGood; });
    std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
        return length(a.step) < length(b.step);
    });
    period.count = 1;
    period.steps[0] = found.front().step;
    period.mismatch = found.front().mismatch;
    for (const Candidate& c : found) {
        if (apart(c.step, period.steps[0]) < 0.4) continue;
        period.steps[1] = c.step;
        period.count = 2;
        break;
    }
    // A single slanting step is more often chance than structure.
    if (period.count == 1 &&
        std::min(std::abs(period.steps[0].x), std::abs(period.steps[0].y)) > 2) {
        period = {};
    }
    return period;
}

TexturePeriod find_period(ViewU8x3 sample) {
    return find_period(self_mismatch(sample));
}

}  // namespace weft
