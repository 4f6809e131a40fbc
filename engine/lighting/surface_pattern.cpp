#include "engine/lighting/surface_pattern.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/core/parallel.h"
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
constexpr float kLeastStep = 0.3f;    // ln units: fainter marks are no marks
constexpr float kDeviations = 3.0f;   // of the ground: what is beyond is not of it
constexpr float kDepthShare = 0.8f;   // the depth of marks is this quantile
constexpr float kLeastDepth = 2.0f;   // times the step that tells them from the ground
constexpr float kShallow = 0.5f;      // of their depth: no more than …
constexpr float kMostShallow = 0.6f;  // … this share is so shallow
// Creases may have one depth, too, but the sky still lights them to half of their surroundings; and
// they have every value up to theirs, where faint paint has two: Sarle's (skewness² + 1) / kurtosis
// of what is beyond the ground. Ink is deeper (ln units). Measured: deep creases 0.67 and 0.79, a
// bedspread's lines 0.87 and 0.69, printed dots 0.66 and 0.90.
constexpr float kInk = 0.75f, kTwoValues = 0.82f;
constexpr float kFewest = 0.01f;       // of the surface
constexpr float kCellSigmas = 8.0f;    // the side of a part of the surface, in blurs
constexpr int kLeastCell = 8;          // pixels
constexpr float kInsideWeight = 0.5f;  // pixels of the rim do not count
constexpr int kFewestParts = 4;        // of a surface that tells
constexpr float kMarkedParts = 0.5f;   // of the parts that have marks
constexpr float kMarkedPart = 0.01f;   // of such a part's pixels

constexpr float kOneGround = 0.5f;  // of the step: the ground's deviation around a mark, at most

// Marks grow along what is as thin as they are, up to kThin of the pattern's size on each side, and
// as faint as kFaintMark of the step: a line that is blurred or far away hardly shows.
constexpr float kThin = 0.2f, kFaintMark = 0.6f;

constexpr int kBridgeRounds = 12;  // a membrane over marks a few pixels wide

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

// Sarle's coefficient of how far the surface is beyond its ground on one side.
float modes_of(const Outliers& found, const ImageF1& weight, float side) {
    double n = 0, sum = 0, second = 0, third = 0, fourth = 0;
    const auto for_each = [&](const auto& visit) {
        for (std::size_t i = 0; i < weight.size_bytes() / sizeof(float); ++i)
            if (weight.data()[i] > kInsideWeight)
                visit(std::max(0.0f, side * found.rest.data()[i]));
    };
    for_each([&](double v) { n += 1, sum += v; });
    for_each([&](double v) {
        const double d = v - sum / n;
        second += d * d, third += d * d * d, fourth += d * d * d * d;
    });
    if (!(second > 0)) return 0;
    return static_cast<float>((third * third / second + second * second / n) / fourth);
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
    return depth > kLeastDepth * found.step && static_cast<float>(shallow) < kMostShallow * count &&
           (depth > kInk || modes_of(found, weight, side) > kTwoValues);
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

int thin_radius(float pattern_px) {
    return std::max(1, static_cast<int>(std::lround(kThin * pattern_px)));
}

// The greatest of `sign` × plane in squares, where `weight` is above 0.
ImageF1 greatest_around(const ImageF1& plane, const ImageF1& weight, float sign, int radius) {
    constexpr float kNone = -1e9f;
    const int width = plane.width(), height = plane.height();
    ImageF1 across(plane.size()), out(plane.size());
    parallel_rows(height, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < width; ++x) {
                float most = kNone;
                for (int u = std::max(0, x - radius); u <= std::min(width - 1, x + radius); ++u)
                    if (weight.row(y)[u] > 0) most = std::max(most, sign * plane.row(y)[u]);
                across.row(y)[x] = most;
            }
        }
    });
    parallel_rows(height, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < width; ++x) {
                float most = kNone;
                for (int v = std::max(0, y - radius); v <= std::min(height - 1, y + radius); ++v)
                    most = std::max(most, across.row(v)[x]);
                out.row(y)[x] = most;
            }
        }
    });
    return out;
}

// How far each place is from both sides of something thin (a top hat: closing less the picture,
// Serra 1982); a fold is too wide to be any of it.
ImageF1 thinness(const ImageF1& luma, const ImageF1& weight, float side, int radius) {
    ImageF1 thin =
        greatest_around(greatest_around(luma, weight, -side, radius), weight, -1.0f, radius);
    for (std::size_t i = 0; i < thin.size_bytes() / sizeof(float); ++i)
        thin.data()[i] = side * luma.data()[i] - thin.data()[i];
    return thin;
}

// What is farther from the ground than the step, on one side.
Matte clear_marks(const Outliers& found, const ImageF1& weight, float side) {
    Matte marks(weight.size());
    for (int y = 0; y < weight.height(); ++y) {
        for (int x = 0; x < weight.width(); ++x) {
            if (weight.row(y)[x] > 0 && side * found.rest.row(y)[x] > found.step)
                marks.row(y)[x] = 255;
        }
    }
    return marks;
}

// And what continues it.
Matte marks_of(const Outliers& found, const ImageF1& luma, const ImageF1& weight, float side,
               int thin_px) {
    const ImageF1 thin = thinness(luma, weight, side, thin_px);
    const int width = weight.width(), height = weight.height();
    Matte marks = clear_marks(found, weight, side);
    std::vector<Vec2i> open;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (marks.row(y)[x]) open.push_back({x, y});
        }
    }
    while (!open.empty()) {
        const Vec2i at = open.back();
        open.pop_back();
        for (int y = std::max(0, at.y - 1); y <= std::min(height - 1, at.y + 1); ++y) {
            for (int x = std::max(0, at.x - 1); x <= std::min(width - 1, at.x + 1); ++x) {
                if (marks.row(y)[x] || !(weight.row(y)[x] > 0) ||
                    !(thin.row(y)[x] > kFaintMark * found.step))
                    continue;
                marks.row(y)[x] = 255;
                open.push_back({x, y});
            }
        }
    }
    return marks;
}

// With the pixels around them, in which they are mixed with the ground.
void take_out(const Matte& marks, const ImageF1& weight, ImageF1& ground) {
    for (int y = 0; y < weight.height(); ++y) {
        for (int x = 0; x < weight.width(); ++x) {
            if (!marks.row(y)[x]) continue;
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

SurfacePattern surface_pattern(const ImageF1& luma, const ImageF1& undecided, const ImageF1& weight,
                               float pattern_px) {
    const float sigma_px = kPatternSigma * pattern_px;
    SurfacePattern out{weight};
    const Outliers found = outliers_of(luma, weight, sigma_px);
    const int cell = std::max(kLeastCell, static_cast<int>(kCellSigmas * sigma_px));
    for (const float side : {-1.0f, 1.0f}) {
        if (!have_one_depth(found, weight, side) || !are_everywhere(found, weight, side, cell))
            continue;
        ImageF1 ground = weight;
        take_out(clear_marks(found, weight, side), weight, ground);
        if (!lie_on_one_ground(luma, weight, ground, found.step,
                               static_cast<int>(2 * sigma_px) + 1))
            continue;
        take_out(marks_of(found, luma, weight, side, thin_radius(pattern_px)), weight, out.ground);
        (side < 0 ? out.marks.dark : out.marks.light) = true;
    }
    const ImageF1 base = blurred(weighted(undecided, out.ground), out.ground, sigma_px).value;
    out.presence = smooth_step(deviation_between(base, undecided, out.ground), kPlain, kPatterned);
    return out;
}

ImageF1 ground_between(const PrintedMarks& marks, const ImageF1& luma, const ImageF1& weight,
                       float pattern_px) {
    ImageF1 ground = weight;
    if (!marks.dark && !marks.light) return ground;
    const Outliers found = outliers_of(luma, weight, kPatternSigma * pattern_px);
    for (const float side : {-1.0f, 1.0f}) {
        if (side < 0 ? !marks.dark : !marks.light) continue;
        take_out(marks_of(found, luma, weight, side, thin_radius(pattern_px)), weight, ground);
    }
    return ground;
}

void bridge_marks(ImageF1& light, const ImageF1& weight, const ImageF1& ground) {
    const int width = light.width(), height = light.height();
    Matte known(light.size());
    std::vector<Vec2i> holes;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            known.row(y)[x] = ground.row(y)[x] > 0 ? 255 : 0;
            if (weight.row(y)[x] > 0 && !known.row(y)[x]) holes.push_back({x, y});
        }
    }
    if (holes.empty()) return;
    ImageF1 filled = light;
    fill_unknown(filled, known);
    for (const Vec2i& at : holes)
        light.row(at.y)[at.x] = filled.row(at.y)[at.x];
    // In one order and in place (Gauss–Seidel), there and back again, so that no side leads.
    const auto relax = [&](const Vec2i& at) {
        float sum = 0, count = 0;
        for (const Vec2i& to : {Vec2i{-1, 0}, Vec2i{1, 0}, Vec2i{0, -1}, Vec2i{0, 1}}) {
            const int x = at.x + to.x, y = at.y + to.y;
            if (x < 0 || y < 0 || x >= width || y >= height || !(weight.row(y)[x] > 0)) continue;
            sum += light.row(y)[x], count += 1;
        }
        if (count > 0) light.row(at.y)[at.x] = sum / count;
    };
    for (int round = 0; round < kBridgeRounds; ++round) {
        std::for_each(holes.begin(), holes.end(), relax);
        std::for_each(holes.rbegin(), holes.rend(), relax);
    }
}

}  // namespace weft
