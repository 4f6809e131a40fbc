#include "engine/mask/boundary_refiner.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/band_cut.h"
#include "engine/mask/edge_alpha.h"
#include "engine/mask/signed_distance.h"

namespace weft {
namespace {

constexpr float kEdgeWidthPx = 1.5f;

// Chosen by sweeps on DAVIS blackswan and dance-twirl and on two objects of a rendered clip. Most
// have little effect there; a colour weight too small against the smoothness lets the matte leak.
constexpr float kColorWeight = 1.5f;
// Shape prior: distance for one unit of log odds, without colours.
constexpr float kShapeReachPx = 4;
constexpr float kSeparableReachPx = 6;  // added to it where colours are reliable
constexpr float kGrowthPenalty = 0.5f;  // log odds against inside, beyond the expected boundary
constexpr float kSmoothness = 2;
constexpr float kWideWeight = 2.3f;
constexpr float kContradiction = 1.0f;  // mean log odds that reopen a decided part
constexpr float kBoilBands = 0.15f;     // 1.5 px at 854×480
constexpr float kIslandBands = 4;       // islands up to this many bands² are removed

// Evidence for inside at every pixel of the band: from colours where they separate, and from the
// shape, which counts more where colours count less (SnapCut eq. 3–5, as a sum of log odds).
struct Evidence {
    ImageF1 log_odds;
    ImageF1 separability;
};

Evidence gather_evidence(ViewU8x3 frame, ViewF1 phi, const LocalColorField& colors,
                         ViewF1 further_odds, ViewF1 wide_odds, ViewU8x1 undecided, float band_px) {
    Evidence e{ImageF1(frame.size()), ImageF1(frame.size())};
    parallel_rows(frame.height(), 8, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < frame.width(); ++x) {
                if (undecided.row(y)[x] == 0) continue;
                // Far from the expected boundary, the shape counts as at the band's end.
                const float d = std::clamp(phi.row(y)[x], -band_px, band_px);
                const std::uint8_t* c = frame.pixel(x, y);
                const ColorProbability p = colors.at(x, y, Vec3(c[0], c[1], c[2]));
                const float q = std::clamp(p.inside, 0.01f, 0.99f);
                const float confidence = p.confidence();
                e.log_odds.row(y)[x] = kColorWeight * confidence * std::log(q / (1 - q)) +
                                       d / (kShapeReachPx + kSeparableReachPx * confidence) -
                                       kGrowthPenalty * std::clamp(-d / 3, 0.0f, 1.0f);
                if (!further_odds.empty()) e.log_odds.row(y)[x] += further_odds.row(y)[x];
                if (!wide_odds.empty()) e.log_odds.row(y)[x] += kWideWeight * wide_odds.row(y)[x];
                e.separability.row(y)[x] = p.separability;
            }
        }
    });
    return e;
}

// The band, and connected pixels whose evidence contradicts the expectation.
Matte undecided_pixels(ViewF1 phi, ViewF1 wide_odds, float band_px, float reach_px) {
    const int w = phi.width(), h = phi.height();
    Matte undecided(phi.size());
    std::vector<Vec2i> open;
    const ImageF1 mean = wide_odds.empty() ? ImageF1() : smooth_distance(wide_odds, 3);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            if (std::abs(phi.row(y)[x]) >= band_px) continue;
            undecided.row(y)[x] = 1;
            if (!mean.empty() && std::abs(phi.row(y)[x]) >= band_px - 2) open.emplace_back(x, y);
        }
    }
    while (!open.empty()) {
        const Vec2i p = open.back();
        open.pop_back();
        for (const Vec2i step : {Vec2i(1, 0), Vec2i(-1, 0), Vec2i(0, 1), Vec2i(0, -1)}) {
            const Vec2i q = p + step;
            if (q.x < 0 || q.y < 0 || q.x >= w || q.y >= h) continue;
            const float d = phi.row(q.y)[q.x], odds = mean.row(q.y)[q.x];
            if (undecided.row(q.y)[q.x] != 0 || std::abs(d) >= reach_px) continue;
            if ((d > 0 ? -odds : odds) < kContradiction) continue;
            undecided.row(q.y)[q.x] = 1;
            open.push_back(q);
        }
    }
    return undecided;
}

BoundaryEvidence weigh(ViewF1 expected, ViewF1 found, const Evidence& e, float band_px) {
    double separability = 0, certainty = 0, moved = 0;
    double beside_expected = 0, beside_found = 0, contour = 0;
    for (int y = 0; y < expected.height(); ++y) {
        for (int x = 0; x < expected.width(); ++x) {
            const float a = expected.row(y)[x], b = found.row(y)[x];
            if (std::abs(a) < 1) {
                separability += static_cast<double>(e.separability.row(y)[x]);
                beside_expected += 1;
            }
            if (std::abs(a) < band_px && std::abs(b) >= 1 && std::abs(b) < 3) {
                const float odds = e.log_odds.row(y)[x];
                certainty += static_cast<double>(1 / (1 + std::exp(b > 0 ? -odds : odds)));
                beside_found += 1;
            }
            if (std::abs(b) < 0.75f) contour += 1;
            if ((a > 0) != (b > 0)) moved += 1;
        }
    }
    BoundaryEvidence result;
    if (beside_expected > 0) {
        result.separability = static_cast<float>(separability / beside_expected);
    }
    if (beside_found > 0) result.certainty = static_cast<float>(certainty / beside_found);
    // Pixels that changed sides per pixel of boundary: the mean displacement.
    // Long double: see docs/decisions/0002-determinism.md.
    const long double slip = moved / std::max(1.0, 1.5 * contour);
    result.steadiness = static_cast<float>(std::exp(-slip));
    return result;
}

// Boil is a boundary that wobbles by a pixel against the surface. A small difference from where the
// surface's motion puts the boundary is removed; a large one is a change of shape and stays.
void hold_steady(ImageF1& found, ViewF1 expected, float band_px, float steadiness) {
    if (steadiness <= 0) return;
    const float boil_px = kBoilBands * band_px;
    parallel_rows(found.height(), 32, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            float* phi = found.row(y);
            const float* e = expected.row(y);
            for (int x = 0; x < found.width(); ++x) {
                const float r = (e[x] - phi[x]) / boil_px;
                if (std::abs(r) < 3) phi[x] += steadiness * std::exp(-r * r) * (e[x] - phi[x]);
            }
        }
    });
}

}  // namespace

RefineScale::RefineScale(Size frame) {
    const double area = static_cast<double>(frame.width) * static_cast<double>(frame.height);
    const auto s = static_cast<float>(std::clamp(std::sqrt(area / (854.0 * 480.0)), 0.5, 8.0));
    band_px = std::max(6.0f, 10 * s);
    window_half_px = static_cast<int>(std::lround(20 * s));
    window_step_px = static_cast<int>(std::lround(12 * s));
    sample_stride = std::max(1, static_cast<int>(std::lround(s)));
    limit_px = 4 * band_px;
}

void place_by_coverage(ImageF1& phi, ViewU8x1 matte) {
    for (int y = 0; y < phi.height(); ++y) {
        float* d = phi.row(y);
        const std::uint8_t* m = matte.row(y);
        for (int x = 0; x < phi.width(); ++x) {
            if (m[x] == 0 || m[x] == 255) continue;
            const float place = (static_cast<float>(m[x]) / 255 - 0.5f) * kEdgeWidthPx;
            d[x] = std::clamp(place, d[x] - 0.75f, d[x] + 0.75f);
        }
    }
}

std::vector<ColorWindow> place_windows(ViewF1 phi, int step_px) {
    std::vector<ColorWindow> windows;
    Image<std::uint8_t, 1> taken(phi.size());
    for (int y = 0; y < phi.height(); ++y) {
        for (int x = 0; x < phi.width(); ++x) {
            if (std::abs(phi.row(y)[x]) >= 1 || taken.row(y)[x] != 0) continue;
            ColorWindow window;
            window.center = Vec2i(x, y);
            windows.push_back(std::move(window));
            const int x0 = std::max(0, x - step_px), x1 = std::min(phi.width(), x + step_px + 1);
            for (int v = y; v < std::min(phi.height(), y + step_px + 1); ++v) {
                std::fill(taken.row(v) + x0, taken.row(v) + x1, std::uint8_t{1});
            }
        }
    }
    return windows;
}

RefinedBoundary refine_boundary(ViewU8x3 frame, ViewF1 expected_phi, const LocalColorField& colors,
                                ViewF1 further_odds, ViewF1 wide_odds, const RefineScale& scale,
                                float steadiness) {
    const Matte undecided =
        undecided_pixels(expected_phi, wide_odds, scale.band_px, scale.limit_px - 1);
    const Evidence evidence = gather_evidence(frame, expected_phi, colors, further_odds, wide_odds,
                                              undecided, scale.band_px);
    auto labels = cut_band(frame, evidence.log_odds, expected_phi, undecided, kSmoothness);
    remove_islands(labels, expected_phi, scale.band_px,
                   static_cast<int>(kIslandBands * scale.band_px * scale.band_px));
    RefinedBoundary result;
    result.phi = smooth_distance(signed_distance(labels, scale.limit_px), 2);
    hold_steady(result.phi, expected_phi, scale.band_px, steadiness);
    result.matte = edge_alpha(frame, result.phi, kEdgeWidthPx);
    result.evidence = weigh(expected_phi, result.phi, evidence, scale.band_px);
    // So that slow motion is not lost to rounding when it is propagated.
    place_by_coverage(result.phi, result.matte);
    return result;
}

Recti working_area(const Recti& bounds, const RefineScale& scale, Size frame) {
    if (bounds.empty()) return bounds;
    const int margin = static_cast<int>(scale.limit_px) + 4;
    return bounds.grown(margin).intersected(rect_of(frame));
}

}  // namespace weft
