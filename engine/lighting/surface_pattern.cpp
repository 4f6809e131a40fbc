#include "engine/lighting/surface_pattern.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/core/smooth_step.h"
#include "engine/lighting/masked_filters.h"
#include "engine/lighting/masked_statistics.h"
#include "engine/lighting/quantile.h"

namespace weft {
namespace {

// A surface whose lightness has a standard deviation below kPlain (ln units) has no pattern: what
// varies is its own shading, such as wrinkles and facets. Above kPatterned all variation is
// pattern.
constexpr float kPlain = 0.08f, kPatterned = 0.16f;

constexpr int kGroundRounds = 3;
constexpr float kLeastStep = 0.3f;     // ln units: fainter marks are no marks
constexpr float kDeviations = 3.0f;    // of the ground: what is beyond is not of it
constexpr float kDepthShare = 0.8f;    // the depth of marks is this quantile
constexpr float kLeastDepth = 2.0f;    // times the step that tells them from the ground
constexpr float kShallow = 0.5f;       // of their depth: no more than …
constexpr float kMostShallow = 0.5f;   // … this share is so shallow
constexpr float kFewest = 0.01f;       // of the surface
constexpr float kCellSigmas = 8.0f;    // the side of a part of the surface, in blurs
constexpr int kLeastCell = 8;          // pixels
constexpr float kInsideWeight = 0.5f;  // pixels of the rim do not count
constexpr int kFewestParts = 4;        // of a surface that tells
constexpr float kMarkedParts = 0.5f;   // of the parts that have marks
constexpr float kMarkedPart = 0.01f;   // of such a part's pixels

constexpr float kOneGround = 0.5f;  // of the step: the ground's deviation around a mark, at most

struct Outliers {
    ImageF1 rest;    // luma over its ground
    float step = 0;  // what is farther from the ground is not of it
};

// The ground by iterated blurs without what is far from it.
Outliers outliers_of(const ImageF1& luma, const ImageF1& weight, float sigma_px) {
    Outliers out{ImageF1(luma.size())};
    ImageF1 ground = weight;
    for (int round = 0; round < kGroundRounds; ++round) {
        const ImageF1 base = blurred(weighted(luma, ground), ground, sigma_px).value;
        out.step = std::max(kLeastStep, kDeviations * deviation_between(luma, base, ground));
        for (std::size_t i = 0; i < luma.size_bytes() / sizeof(float); ++i) {
            out.rest.data()[i] = luma.data()[i] - base.data()[i];
            ground.data()[i] = std::abs(out.rest.data()[i]) > out.step ? 0.0f : weight.data()[i];
        }
    }
    return out;
}

// Whether the outliers on one side, +1 or −1, have one depth.
bool have_one_depth(const Outliers& found, const ImageF1& weight, float side) {
    std::vector<float> depths;
    std::size_t all = 0;
    for (std::size_t i = 0; i < weight.size_bytes() / sizeof(float); ++i) {
        if (!(weight.data()[i] > kInsideWeight)) continue;
        ++all;
        if (side * found.rest.data()[i] > found.step) depths.push_back(side * found.rest.data()[i]);
    }
    const auto count = static_cast<float>(depths.size());
    if (depths.empty() || count < kFewest * static_cast<float>(all)) return false;
    const float depth = quantile(depths, kDepthShare);
    const auto shallow =
        std::count_if(depths.begin(), depths.end(), [&](float d) { return d < kShallow * depth; });
    return depth > kLeastDepth * found.step && static_cast<float>(shallow) < kMostShallow * count;
}

// Whether they are all over the surface.
bool are_everywhere(const Outliers& found, const ImageF1& weight, float side, int cell) {
    int parts = 0, marked_parts = 0;
    for (int y0 = 0; y0 < weight.height(); y0 += cell) {
        for (int x0 = 0; x0 < weight.width(); x0 += cell) {
            int area = 0, marked = 0;
            for (int y = y0; y < std::min(weight.height(), y0 + cell); ++y) {
                for (int x = x0; x < std::min(weight.width(), x0 + cell); ++x) {
                    if (!(weight.row(y)[x] > kInsideWeight)) continue;
                    ++area;
                    marked += side * found.rest.row(y)[x] > found.step ? 1 : 0;
                }
            }
            if (2 * area < cell * cell) continue;
            ++parts;
            marked_parts += static_cast<float>(marked) > kMarkedPart * static_cast<float>(area);
        }
    }
    return parts >= kFewestParts &&
           static_cast<float>(marked_parts) >= kMarkedParts * static_cast<float>(parts);
}

// With the pixels around them, in which they are mixed with the ground.
void take_out(const Outliers& found, const ImageF1& weight, float side, ImageF1& ground) {
    for (int y = 0; y < weight.height(); ++y) {
        for (int x = 0; x < weight.width(); ++x) {
            if (!(weight.row(y)[x] > 0) || !(side * found.rest.row(y)[x] > found.step)) continue;
            for (int v = std::max(0, y - 1); v <= std::min(weight.height() - 1, y + 1); ++v)
                for (int u = std::max(0, x - 1); u <= std::min(weight.width() - 1, x + 1); ++u)
                    ground.row(v)[u] = 0;
        }
    }
}

// Whether the ground is the same on both sides of what was taken out of it. The rim of an area that
// is too wide for the blur has the area on one side.
bool lie_on_one_ground(const ImageF1& luma, const ImageF1& weight, const ImageF1& ground,
                       float step, int radius) {
    ImageF1 total = ground, mean = weighted(luma, ground), square = weighted(mean, luma);
    for (ImageF1* plane : {&total, &mean, &square})
        box_blur(*plane, radius);
    std::vector<float> deviations;
    for (std::size_t i = 0; i < luma.size_bytes() / sizeof(float); ++i) {
        if (!(weight.data()[i] > kInsideWeight) || ground.data()[i] > 0) continue;
        const float n = total.data()[i];
        if (!(n > kLeastWeight)) return false;
        const float m = mean.data()[i] / n;
        deviations.push_back(std::sqrt(std::max(0.0f, square.data()[i] / n - m * m)));
    }
    return !deviations.empty() && quantile(deviations, 0.5f) < kOneGround * step;
}

}  // namespace

SurfacePattern surface_pattern(const ImageF1& luma, const ImageF1& weight, float pattern_px) {
    const float sigma_px = kPatternSigma * pattern_px;
    SurfacePattern out{weight};
    const Outliers found = outliers_of(luma, weight, sigma_px);
    const int cell = std::max(kLeastCell, static_cast<int>(kCellSigmas * sigma_px));
    for (const float side : {-1.0f, 1.0f}) {
        if (!have_one_depth(found, weight, side) || !are_everywhere(found, weight, side, cell))
            continue;
        ImageF1 ground = weight;
        take_out(found, weight, side, ground);
        if (!lie_on_one_ground(luma, weight, ground, found.step,
                               static_cast<int>(2 * sigma_px) + 1))
            continue;
        take_out(found, weight, side, out.ground);
        (side < 0 ? out.marks.dark : out.marks.light) = true;
    }
    const ImageF1 base = blurred(weighted(luma, out.ground), out.ground, sigma_px).value;
    out.presence = smooth_step(deviation_between(base, luma, out.ground), kPlain, kPatterned);
    return out;
}

ImageF1 ground_between(const PrintedMarks& marks, const ImageF1& luma, const ImageF1& weight,
                       float pattern_px) {
    ImageF1 ground = weight;
    if (!marks.dark && !marks.light) return ground;
    const Outliers found = outliers_of(luma, weight, kPatternSigma * pattern_px);
    if (marks.dark) take_out(found, weight, -1, ground);
    if (marks.light) take_out(found, weight, 1, ground);
    return ground;
}

}  // namespace weft
