// The lattice in the sample's correlation with itself: of all pairs of its peaks the pair whose
// whole combinations are peaks and whose half steps are not. Far peaks then say the steps to a
// fraction of a pixel.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/synthesis/lattice_checks.h"
#include "engine/synthesis/sample_lattice.h"
#include "engine/synthesis/self_correlation.h"

namespace weft {
namespace {

constexpr double kLeastStep_px = 6;
constexpr int kPeakBorder = 2, kFlank_px = 5;
constexpr int kLargestSearched = 512;
constexpr std::size_t kMostPeaks = 24;
constexpr double kLeastHeight = 0.08;
constexpr double kLeastMatch = 0.3;  // Of a lattice with two steps.
// Of what resembles itself so much at two places or more, less contrast is no chance: woven bricks
// are like themselves half a step on, too.
constexpr double kMostResidual_px = 1;
// Enough for a lattice without a mirror.
constexpr int kPlentyRepeats = 6;
constexpr double kPlentyMatch = 0.6;
constexpr double kSureMatch = 0.5, kSureContrast = 0.2;

// A lattice of which few repeats lie within reach may be chance.
double least_contrast(int count, int repeats) {
    if (count == 1) return repeats < 2 ? 0.6 : repeats < 3 ? 0.4 : 0.25;
    return repeats < 2 ? 0.4 : repeats < 6 ? 0.3 : repeats < 20 ? 0.2 : 0.14;
}

std::vector<Vec2i> peaks_of(const SelfCorrelation& c) {
    struct Peak {
        Vec2i at;
        double height;
    };
    std::vector<Peak> found;
    for (int dy = 0; dy <= c.reach.y - kPeakBorder; ++dy) {
        for (int dx = -c.reach.x + kPeakBorder; dx <= c.reach.x - kPeakBorder; ++dx) {
            const Vec2i d{dx, dy};
            if ((dy == 0 && dx <= 0) || glm::length(glm::dvec2(d)) < kLeastStep_px) continue;
            if (c.at(d) < kLeastHeight || *best_near(c, d, kPeakBorder) != d) continue;
            // A ripple on the flank of something beyond reach.
            const bool far =
                std::max(std::abs(d.x), dy) + kFlank_px > std::max(c.reach.x, c.reach.y);
            if (far && *best_near(c, d, kFlank_px) != d) continue;
            // The slope around the origin is not repetition.
            double valley = 1;
            constexpr int kSteps = 12;
            for (int k = 1; k < kSteps; ++k)
                valley = std::min(valley, c.at({dx * k / kSteps, dy * k / kSteps}));
            if (c.at(d) - valley > 0.1) found.push_back({d, c.at(d)});
        }
    }
    // The highest, and the shortest of the others: both kinds hold the lattice's own steps.
    std::stable_sort(found.begin(), found.end(),
                     [](const Peak& a, const Peak& b) { return a.height > b.height; });
    const auto half =
        found.begin() + static_cast<std::ptrdiff_t>(std::min(found.size(), kMostPeaks / 2));
    std::stable_sort(half, found.end(), [](const Peak& a, const Peak& b) {
        return glm::length(glm::dvec2(a.at)) < glm::length(glm::dvec2(b.at));
    });
    found.resize(std::min(found.size(), kMostPeaks));
    std::vector<Vec2i> out(found.size());
    std::ranges::transform(found, out.begin(), &Peak::at);
    return out;
}

struct Contrast {
    /// Mean correlation on the lattice less that at half steps: of the three kinds of half steps
    /// the one that is most alike, so that a step along planks or stripes is none.
    double value = 0;
    int repeats = 0;  ///< Combinations of the steps within reach.

    double match = 0;  ///< Mean correlation on the lattice.

    [[nodiscard]] bool holds(int count) const {
        const bool sure =
            count == 2 && repeats > 1 && match >= kSureMatch && value >= kSureContrast;
        return repeats > 0 && (value >= least_contrast(count, repeats) || sure) &&
               (count == 1 || match >= kLeastMatch);
    }
};

// Steps that are not exact yet (`drift_px` a step) may miss by so
// much more the farther a combination lies.
Contrast contrast(const SelfCorrelation& c, const std::array<glm::dvec2, 2>& s, int far,
                  double drift_px) {
    // By the parity of the half steps: 0 on the lattice, 1 to 3 beside it.
    std::array<double, 4> sums{};
    std::array<int, 4> counts{};
    for (int j = -2 * far; j <= 2 * far; ++j) {
        for (int i = -2 * far; i <= 2 * far; ++i) {
            const glm::dvec2 exact =
                0.5 * (static_cast<double>(i) * s[0] + static_cast<double>(j) * s[1]);
            const Vec2i d = nearest(exact);
            if (d.y < 0 || (d.y == 0 && d.x <= 0) || !c.covers(d)) continue;
            const int turns = (std::max(std::abs(i), std::abs(j)) + 1) / 2;
            const auto best = best_near(c, d, 1 + static_cast<int>(drift_px * turns));
            const int kind_of = std::abs(i % 2) + 2 * std::abs(j % 2);
            const auto kind = static_cast<std::size_t>(kind_of);
            sums[kind] += c.at(*best), ++counts[kind];
        }
    }
    double beside = -1;
    for (const std::size_t kind : {0, 1, 2, 3}) {
        if (counts[kind] == 0) return {};
        sums[kind] /= counts[kind];
        if (kind > 0) beside = std::max(beside, sums[kind]);
    }
    return {sums[0] - beside, counts[0], sums[0]};
}

// A peak's place to a fraction of a pixel, by a parabola along each axis.
glm::dvec2 refined(const SelfCorrelation& c, Vec2i d) {
    const auto along = [&](Vec2i step) {
        if (!c.covers(d + step) || !c.covers(d - step)) return 0.0;
        const double before = c.at(d - step), here = c.at(d), after = c.at(d + step);
        const double bend = before - 2 * here + after;
        return bend < -1e-9 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
    };
    return glm::dvec2(d) + glm::dvec2{along({1, 0}), along({0, 1})};
}

struct Fit {
    std::array<glm::dvec2, 2> steps;
    double residual_px = 0;
};

// Least squares over the peaks near the lattice's combinations, nearest ones first, so that the
// steps are known well enough when the far ones are looked for.
Fit fitted(const SelfCorrelation& c, std::array<glm::dvec2, 2> s) {
    Fit fit{s, 0};
    const double shortest = std::min(glm::length(s[0]), glm::length(s[1]));
    for (const int far : {1, 2, 4, 8, 16, 32}) {
        glm::dvec2 ip{0}, jp{0};
        double ii = 0, ij = 0, jj = 0, squares = 0, weights = 0;
        for (int j = -far; j <= far; ++j) {
            for (int i = -far; i <= far; ++i) {
                const glm::dvec2 expected =
                    static_cast<double>(i) * fit.steps[0] + static_cast<double>(j) * fit.steps[1];
                const Vec2i d = nearest(expected);
                if (d.y < 0 || (d.y == 0 && d.x <= 0) || !c.covers(d)) continue;
                const int radius = std::clamp(static_cast<int>(0.2 * shortest), 1, 4);
                const auto best = best_near(c, d, radius);
                // Not a peak but the flank of something else.
                if (!c.covers(*best + Vec2i{1, 1}) || !c.covers(*best - Vec2i{1, 1})) continue;
                if (*best_near(c, *best, 1) != *best || c.at(*best) <= 0) continue;
                const double w = c.at(*best) * c.at(*best);
                const glm::dvec2 p = refined(c, *best);
                ii += w * i * i, ij += w * i * j, jj += w * j * j;
                ip += w * i * p, jp += w * j * p;
                const glm::dvec2 miss = p - expected;
                squares += w * glm::dot(miss, miss), weights += w;
            }
        }
        const double det = ii * jj - ij * ij;
        if (det < 1e-9 * (ii + jj) * (ii + jj) || weights <= 0) continue;
        fit.steps = {(jj * ip - ij * jp) / det, (ii * jp - ij * ip) / det};
        fit.residual_px = std::sqrt(squares / weights);
    }
    return fit;
}

struct Found {
    SampleLattice lattice;
    Contrast contrast;
};

// The lattice that the correlation has near `steps`, of whole units; none where it is not sure.
Found lattice_near(const SelfCorrelation& c, const std::array<glm::dvec2, 2>& steps) {
    const Fit fine = fitted(c, steps);
    const auto reach_over = [&](const std::array<glm::dvec2, 2>& both) {
        return std::ranges::all_of(both, [&](glm::dvec2 v) { return c.covers(nearest(v)); });
    };
    if (fine.residual_px > kMostResidual_px || !reach_over(reduced(fine.steps))) return {};
    Found out;
    out.contrast = contrast(c, fine.steps, 8, 0);
    const bool plenty =
        out.contrast.repeats >= kPlentyRepeats && out.contrast.match >= kPlentyMatch;
    if (!is_symmetric(reduced(fine.steps)) && !plenty) return {};
    const Fit fit = fitted(c, whole_units(c, fine.steps));
    out.lattice = {2,
                   reduced(fit.steps),
                   std::clamp(out.contrast.value, 0.0, 1.0),
                   out.contrast.match,
                   out.contrast.repeats,
                   fit.residual_px};
    return out;
}

Found two_steps(const SelfCorrelation& c) {
    const std::vector<Vec2i> peaks = peaks_of(c);
    struct Candidate {
        std::array<glm::dvec2, 2> steps;
        Contrast contrast;
        double area;
    };
    std::vector<Candidate> found;
    for (std::size_t i = 0; i < peaks.size(); ++i) {
        for (std::size_t j = i + 1; j < peaks.size(); ++j) {
            const glm::dvec2 a = peaks[i], b = peaks[j];
            const double area = std::abs(a.x * b.y - a.y * b.x);
            if (area < 0.3 * glm::length(a) * glm::length(b)) continue;
            const Contrast here = contrast(c, {a, b}, 2, 1);
            if (here.holds(2) && is_even(c, {a, b})) found.push_back({{a, b}, here, area});
        }
    }
    if (found.empty()) return {};
    const Candidate clearest = *std::max_element(
        found.begin(), found.end(),
        [](const Candidate& a, const Candidate& b) { return a.contrast.value < b.contrast.value; });
    const double clear = 0.5 * clearest.contrast.value;
    double match = clearest.contrast.match;
    for (const Candidate& k : found) {
        if (k.contrast.value >= clear && k.contrast.repeats > 1)
            match = std::max(match, k.contrast.match);
    }
    // Every second or third step repeats as well; the finest that matches as well is the lattice.
    // Half a brick of a basket weave or a herringbone is finer and does not.
    const Candidate* best = nullptr;
    for (const Candidate& k : found) {
        if (k.contrast.match < 0.85 * match || k.contrast.value < clear) continue;
        if (!best || k.area < best->area - 0.5 ||
            (k.area < best->area + 0.5 && k.contrast.value > best->contrast.value)) {
            best = &k;
        }
    }
    return lattice_near(c, best->steps);
}

struct WaveFit {
    glm::dvec2 wave{0};
    double residual_px = -1;  ///< Below 0: nothing could be fitted.
};

// n = (u, v) · wave over the ridges' crests of `at`(u, v), by least squares, near ridges first.
template <class At>
WaveFit fitted_wave(const At& at, int along, int across, double step) {
    double uu = 0, uv = 0, vv = 0, un = 0, vn = 0, squares = 0, weights = 0;
    glm::dvec2 wave{0, 1 / step};
    for (const int far : {1, 2, 4, 8, 16}) {
        uu = uv = vv = un = vn = squares = weights = 0;
        for (int n = 1; n <= far; ++n) {
            for (int u = -along; u <= along; ++u) {
                const double expected = (n - wave.x * u) / wave.y;
                const int v = static_cast<int>(std::lround(expected)), radius = 2;
                if (v - radius < 1 || v + radius >= across) continue;
                int crest = v - radius;
                for (int k = v - radius; k <= v + radius; ++k)
                    if (at(u, k) > at(u, crest)) crest = k;
                const double before = at(u, crest - 1), here = at(u, crest),
                             after = at(u, crest + 1);
                const double bend = before - 2 * here + after;
                if (here < before || here < after || here <= 0 || bend > -1e-9) continue;
                const double w = here * here, p = crest + 0.5 * (before - after) / bend;
                uu += w * u * u, uv += w * u * p, vv += w * p * p;
                un += w * u * n, vn += w * p * n;
                squares += w * (p - expected) * (p - expected), weights += w;
            }
        }
        const double det = uu * vv - uv * uv;
        if (det <= 1e-9 * (uu + vv) * (uu + vv)) break;
        wave = {(vv * un - uv * vn) / det, (uu * vn - uv * un) / det};
    }
    if (weights <= 0 || !(wave.y > 0)) return {};
    return {wave, std::sqrt(squares / weights)};
}

// Planks and stripes along x (or y): all moves along them are alike, and the waves across may lean
// a little.
Found one_step(const SelfCorrelation& c, bool along_x) {
    const int across = along_x ? c.reach.y : c.reach.x,
              along = (along_x ? c.reach.x : c.reach.y) / 2;
    const auto at = [&](int u, int v) { return c.at(along_x ? Vec2i{u, v} : Vec2i{v, u}); };
    std::vector<double> profile, least;
    for (int v = 0; v <= across; ++v) {
        double sum = 0;
        for (int u = -along; u <= along; ++u)
            sum += at(u, v);
        profile.push_back(sum / (2 * along + 1));
    }
    const auto best_at = [&](double v, int radius) {
        const int m = static_cast<int>(std::lround(v));
        double best = -1;
        for (int k = std::max(0, m - radius); k <= std::min(across, m + radius); ++k)
            best = std::max(best, profile[static_cast<std::size_t>(k)]);
        return best;
    };
    const auto contrast_of = [&](double step) {
        double on = 0, off = 0;
        int n = 0;
        for (; n < 4 && (n + 1) * step <= across; ++n) {
            on += best_at((n + 1) * step, 1 + n / 2);
            off += best_at((n + 0.5) * step, 1 + n / 2);
        }
        return n == 0 ? Contrast{} : Contrast{(on - off) / n, n, on / n};
    };
    double step = 0;
    Found out;
    for (int v = static_cast<int>(kLeastStep_px); v < across; ++v) {
        const auto k = static_cast<std::size_t>(v);
        if (profile[k] < profile[k - 1] || profile[k] < profile[k + 1]) continue;
        const Contrast contrast = contrast_of(v);
        if (!contrast.holds(1) || contrast.value <= out.contrast.value / 0.85) continue;
        step = v, out.contrast = contrast;
    }
    if (step == 0) return out;
    if (!is_free_along(c, step, along_x)) {
        const auto joints = joints_in_courses(c, step, along_x);
        if (!joints) return {};
        const Found found = lattice_near(c, *joints);
        const bool sure = found.lattice.count == 2 && found.lattice.match >= kLeastMatch &&
                          is_even(c, found.lattice.steps);
        return sure ? found : Found{};
    }
    const WaveFit fit = fitted_wave(at, along, across, step);
    if (fit.residual_px < 0) return out;
    const glm::dvec2 turned = along_x ? fit.wave : glm::dvec2{fit.wave.y, fit.wave.x};
    out.lattice = {1,
                   {turned / glm::dot(turned, turned), {}},
                   std::clamp(out.contrast.value, 0.0, 1.0),
                   out.contrast.match,
                   out.contrast.repeats,
                   fit.residual_px};
    return out;
}

ImageU8x3 halved(ViewU8x3 s) {
    ImageU8x3 out(s.width() / 2, s.height() / 2);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            for (int c = 0; c < 3; ++c) {
                const int sum = s.pixel(2 * x, 2 * y)[c] + s.pixel(2 * x + 1, 2 * y)[c] +
                                s.pixel(2 * x, 2 * y + 1)[c] + s.pixel(2 * x + 1, 2 * y + 1)[c];
                out.pixel(x, y)[c] = static_cast<std::uint8_t>((sum + 2) / 4);
            }
        }
    }
    return out;
}

// Two steps say more than one and are taken where they hold.
Found best_of(const SelfCorrelation& c) {
    Found best = two_steps(c);
    if (best.contrast.holds(2)) return best;
    best = {};
    for (const bool along_x : {true, false}) {
        const Found one = one_step(c, along_x);
        if (one.contrast.value > best.contrast.value) best = one;
    }
    return best;
}

}  // namespace

SampleLattice find_lattice(ViewU8x3 sample, const SelfMismatch& self) {
    const SelfCorrelation near = correlation_of(self);
    Found found = best_of(near);
    const Size s{std::min(sample.width(), kLargestSearched),
                 std::min(sample.height(), kLargestSearched)};
    if (s.width <= 2 * near.reach.x + 1 && s.height <= 2 * near.reach.y + 1) return found.lattice;
    const int x0 = (sample.width() - s.width) / 2, y0 = (sample.height() - s.height) / 2;
    const ViewU8x3 middle = sample.crop({x0, y0, x0 + s.width, y0 + s.height});
    // Steps that only show in more of a large sample.
    if (found.lattice.count == 0) {
        found = best_of(correlation_of(halved(middle).view()));
        for (glm::dvec2& step : found.lattice.steps)
            step *= 2.0;
    }
    if (found.lattice.count == 2) {
        const Fit fit = fitted(correlation_of(middle), found.lattice.steps);
        found.lattice.steps = reduced(fit.steps);
        found.lattice.residual_px = fit.residual_px;
    }
    return found.lattice;
}

SampleLattice find_lattice(ViewU8x3 sample) {
    return find_lattice(sample, self_mismatch(sample));
}

}  // namespace weft
