#include "engine/lighting/still_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/core/luma.h"
#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/lighting/coverage.h"
#include "engine/lighting/fast_math.h"
#include "engine/lighting/masked_filters.h"
#include "engine/lighting/quantile.h"

namespace weft {
namespace {

using Part = StillSurfaceGatherer::Part;

constexpr float kSplatHit = 0.1f;  // of a pixel: less was hit by chance
constexpr int kFewestStillFrames = 4;
constexpr std::size_t kFewestPlaces = 64;
constexpr float kDarkestFrames = 0.25f;  // of the frames
constexpr float kLowQuarter = 0.25f;
constexpr float kBlack = 1e-4f;  // linear light
constexpr int kStillLevelRounds = 2;
constexpr float kFadedShare = 0.05f;  // of the usual light: what a fade leaves of gloss is noise
constexpr int kPaintWindow = 3;       // radius in which paint is compared with what moves, pixels

// What tells gloss from moving shadows, measured on rendered surfaces with gloss and without.
// Highlights are bright and rare, so the median over time lies near the dark end.
constexpr float kEven = 0.12f, kRare = 0.35f;
// The range over time, of the usual light: below this it is noise and errors of the motion.
constexpr float kStill = 0.1f, kMoves = 0.25f;
// Light is multiplied by the paint's pattern, gloss is not: the slope of what moves on the pattern,
// 1 for light; and the contrast of a pattern that tells.
constexpr float kAdded = 0.3f, kMultiplied = 0.6f;
constexpr float kPlainPaint = 0.03f, kPatternedPaint = 0.08f;

// A frame's surface at the reduced size.
struct Reduced {
    Recti box;
    ImageF3 colour;
    ImageF1 known;  // 1 where all of a pixel shows the surface, else 0
};

// `origin` of `plate` and `visible` in the frame.
Reduced reduced(Vec2i origin, ViewF3 plate, ViewU8x1 visible, int d) {
    Reduced out;
    out.box = {origin.x / d, origin.y / d, (origin.x + plate.width() + d - 1) / d,
               (origin.y + plate.height() + d - 1) / d};
    out.colour = ImageF3(out.box.size());
    out.known = ImageF1(out.box.size());
    parallel_rows(out.box.height(), 8, [&](int r0, int r1) {
        for (int y = r0; y < r1; ++y) {
            for (int x = 0; x < out.box.width(); ++x) {
                const int left = (out.box.x0 + x) * d - origin.x;
                const int top = (out.box.y0 + y) * d - origin.y;
                if (left < 0 || top < 0 || left + d > plate.width() || top + d > plate.height())
                    continue;
                std::array<float, 3> sum{};
                bool whole = true;
                for (int v = top; v < top + d; ++v) {
                    for (int u = left; u < left + d; ++u) {
                        const float* p = plate.pixel(u, v);
                        whole = whole && visible.row(v)[u] >= kUnmixedFrom &&
                                std::isfinite(p[0] + p[1] + p[2]);
                        for (std::size_t c = 0; c < 3; ++c)
                            sum[c] += std::max(0.0f, p[c]);
                    }
                }
                if (!whole) continue;
                out.known.row(y)[x] = 1;
                for (std::size_t c = 0; c < 3; ++c)
                    out.colour.pixel(x, y)[c] = sum[c] / static_cast<float>(d * d);
            }
        }
    });
    return out;
}

// Where a frame's pixels lie on the reduced reference frame, in its pixels.
ImageF2 places(const Reduced& frame, int d, float pixel_px, const LatticeField& ref_from_cur) {
    ImageF2 out(frame.box.size());
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                if (frame.known.row(y)[x] == 0) continue;
                const Vec2 at =
                    static_cast<float>(d) * Vec2(static_cast<float>(frame.box.x0 + x) + 0.5f,
                                                 static_cast<float>(frame.box.y0 + y) + 0.5f);
                const Vec2 there = (at + ref_from_cur.at(at)) / pixel_px;
                out.pixel(x, y)[0] = there.x - 0.5f, out.pixel(x, y)[1] = there.y - 0.5f;
            }
        }
    });
    return out;
}

// The box of the places, at most a frame beyond `frame` on each side.
Recti box_of(const ImageF2& at, const ImageF1& known, Size frame) {
    const Recti most{-frame.width, -frame.height, 2 * frame.width, 2 * frame.height};
    Recti out;
    for (int y = 0; y < at.height(); ++y) {
        for (int x = 0; x < at.width(); ++x) {
            const float *p = at.pixel(x, y), u = p[0], v = p[1];
            if (known.row(y)[x] == 0 || !(std::abs(u) < 1e6f && std::abs(v) < 1e6f)) continue;
            const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
            out = out.united(Recti{i, j, i + 2, j + 2}.intersected(most));
        }
    }
    return out;
}

// Puts a frame on the reference frame, bilinearly.
Part splat_frame(const Reduced& frame, const ImageF2& at, const Recti& box) {
    Part part;
    part.box = box;
    part.colour = ImageF3(box.size());
    part.weight = ImageF1(box.size());
    for (int y = 0; y < at.height(); ++y) {
        for (int x = 0; x < at.width(); ++x) {
            if (frame.known.row(y)[x] == 0) continue;
            const float u = at.pixel(x, y)[0] - static_cast<float>(box.x0);
            const float v = at.pixel(x, y)[1] - static_cast<float>(box.y0);
            if (!(u >= 0 && v >= 0 && u < static_cast<float>(box.width() - 1) &&
                  v < static_cast<float>(box.height() - 1)))
                continue;
            const int i = static_cast<int>(u), j = static_cast<int>(v);
            const float fx = u - static_cast<float>(i), fy = v - static_cast<float>(j);
            const float* from = frame.colour.pixel(x, y);
            const auto put = [&](int a, int b, float share) {
                part.weight.row(b)[a] += share;
                for (int c = 0; c < 3; ++c)
                    part.colour.pixel(a, b)[c] += share * from[c];
            };
            put(i, j, (1 - fx) * (1 - fy)), put(i + 1, j, fx * (1 - fy));
            put(i, j + 1, (1 - fx) * fy), put(i + 1, j + 1, fx * fy);
        }
    }
    for (int y = 0; y < box.height(); ++y) {
        for (int x = 0; x < box.width(); ++x) {
            float& w = part.weight.row(y)[x];
            for (int c = 0; w > kSplatHit && c < 3; ++c)
                part.colour.pixel(x, y)[c] /= w;
            w = w > kSplatHit ? 1.0f : 0.0f;
        }
    }
    return part;
}

// A part's colour at a place of the canvas, or null.
const float* seen_at(const Part& part, int x, int y) {
    const int u = x - part.box.x0, v = y - part.box.y0;
    const bool inside = u >= 0 && v >= 0 && u < part.box.width() && v < part.box.height();
    return inside && part.weight.row(v)[u] > 0 ? part.colour.pixel(u, v) : nullptr;
}

// The frames that show a place, from the darkest to the brightest.
using Shown = std::vector<std::pair<float, int>>;  // luminance at level 1, part

void shown_at(const std::vector<Part>& parts, int x, int y, Shown& out) {
    out.clear();
    for (std::size_t k = 0; k < parts.size(); ++k)
        if (const float* p = seen_at(parts[k], x, y))
            out.emplace_back(luma_709(p) / parts[k].level, static_cast<int>(k));
    std::sort(out.begin(), out.end());
}

float ln_ratio(float value, float usual) {
    return fast_log(std::max(value, kBlack) / std::max(usual, kBlack));
}

// The lower quartile of ln(part / usual); 0 where too little is seen.
float low_level(const Part& part, const Recti& box, const ImageF1& usual, const ImageF1& known) {
    std::vector<float> ratios;
    for (int v = 0; v < part.box.height(); ++v) {
        for (int u = 0; u < part.box.width(); ++u) {
            const int x = u + part.box.x0 - box.x0, y = v + part.box.y0 - box.y0;
            if (part.weight.row(v)[u] > 0 && known.row(y)[x] > 0)
                ratios.push_back(ln_ratio(luma_709(part.colour.pixel(u, v)), usual.row(y)[x]));
        }
    }
    return ratios.size() < kFewestPlaces ? 0.0f : quantile(ratios, kLowQuarter);
}

// How the places change with time.
struct Changes {
    double skew = 0, range2 = 0, middle = 0, places = 0;
};

// Fills colour and known; `middle`: the median luminance over time.
Changes darkest(const std::vector<Part>& parts, StillSurface& out, ImageF1& middle) {
    std::vector<Changes> rows(static_cast<std::size_t>(out.box.height()));
    parallel_rows(out.box.height(), 8, [&](int y0, int y1) {
        Shown shown;
        for (int y = y0; y < y1; ++y) {
            Changes& row = rows[static_cast<std::size_t>(y)];
            for (int x = 0; x < out.box.width(); ++x) {
                shown_at(parts, x + out.box.x0, y + out.box.y0, shown);
                const std::size_t n = shown.size();
                if (static_cast<int>(n) < kFewestStillFrames) continue;
                const auto few = std::max<std::size_t>(
                    1,
                    static_cast<std::size_t>(std::lround(kDarkestFrames * static_cast<float>(n))));
                float* colour = out.colour.pixel(x, y);
                for (std::size_t k = 0; k < few; ++k) {
                    const Part& part = parts[static_cast<std::size_t>(shown[k].second)];
                    const float* p = seen_at(part, x + out.box.x0, y + out.box.y0);
                    for (int c = 0; c < 3; ++c)
                        colour[c] += p[c] / (part.level * static_cast<float>(few));
                }
                out.known.row(y)[x] = 1;
                const double low = shown[n / 10].first, mid = shown[n / 2].first;
                const double high = shown[n - 1 - n / 10].first;
                middle.row(y)[x] = shown[n / 2].first;
                row.skew += ((high - mid) - (mid - low)) * (high - low);
                row.range2 += (high - low) * (high - low);
                row.middle += mid, row.places += 1;
            }
        }
    });
    Changes all;
    for (const Changes& row : rows) {
        all.skew += row.skew, all.range2 += row.range2;
        all.middle += row.middle, all.places += row.places;
    }
    return all;
}

// Of fine differences of what moves: x, as they would be if the paint multiplied it, y, as they
// are.
struct Pattern {
    double xx = 0, xy = 0, moved = 0;  // moved: energy of what moves, over the windows
};

void add_pattern(const Part& part, const StillSurface& still, Pattern& sums) {
    ImageF1 known(part.box.size()), paint(part.box.size()), beyond(part.box.size());
    for (int y = 0; y < part.box.height(); ++y) {
        for (int x = 0; x < part.box.width(); ++x) {
            const int u = x + part.box.x0 - still.box.x0, v = y + part.box.y0 - still.box.y0;
            if (part.weight.row(y)[x] == 0 || still.known.row(v)[u] == 0) continue;
            known.row(y)[x] = 1;
            paint.row(y)[x] = luma_709(still.colour.pixel(u, v));
            beyond.row(y)[x] = luma_709(part.colour.pixel(x, y)) / part.level - paint.row(y)[x];
        }
    }
    ImageF1 count = known, mean_paint = paint, mean_beyond = beyond;
    for (ImageF1* plane : {&count, &mean_paint, &mean_beyond})
        box_blur(*plane, kPaintWindow);
    for (std::size_t i = 0; i < known.size_bytes() / sizeof(float); ++i) {
        const float n = count.data()[i];
        if (known.data()[i] == 0 || !(mean_paint.data()[i] > kBlack * n)) continue;
        const double a = mean_paint.data()[i] / n, e = mean_beyond.data()[i] / n;
        const double x = (paint.data()[i] - a) * e / a, y = beyond.data()[i] - e;
        sums.xx += x * x, sums.xy += x * y, sums.moved += e * e;
    }
}

// 1 where what moves is added to the paint, 0 where the paint multiplies it. A plain surface does
// not tell: there light of sun and sky may be moving.
float added_share(const std::vector<Part>& parts, const StillSurface& still, float daylight) {
    Pattern sums;
    for (const Part& part : parts)
        add_pattern(part, still, sums);
    if (!(sums.xx > 0 && sums.moved > 0)) return 1 - daylight;
    const float patterned = smooth_step(static_cast<float>(std::sqrt(sums.xx / sums.moved)),
                                        kPlainPaint, kPatternedPaint);
    const float multiplied =
        smooth_step(static_cast<float>(sums.xy / sums.xx), kAdded, kMultiplied);
    return patterned * (1 - multiplied) + (1 - patterned) * (1 - daylight);
}

float confidence_in(const Changes& changes, float added) {
    if (!(changes.range2 > 0 && changes.middle > 0)) return 0;
    const double range = std::sqrt(changes.range2 / changes.places);
    const double skew = changes.skew / changes.range2;
    return smooth_step(static_cast<float>(range * changes.places / changes.middle), kStill,
                       kMoves) *
           smooth_step(static_cast<float>(skew), kEven, kRare) * added;
}

// The still surface as the frame sees it; false where it is not known.
bool look_up_still(const StillSurface& still, const float* at, float& luma) {
    const float u = at[0] - static_cast<float>(still.box.x0);
    const float v = at[1] - static_cast<float>(still.box.y0);
    if (!(u >= 0 && v >= 0 && u < static_cast<float>(still.box.width() - 1) &&
          v < static_cast<float>(still.box.height() - 1)))
        return false;
    const int x = static_cast<int>(u), y = static_cast<int>(v);
    const float fx = u - static_cast<float>(x), fy = v - static_cast<float>(y);
    const float *k0 = still.known.pixel(x, y), *k1 = still.known.pixel(x, y + 1);
    if (!(std::min({k0[0], k0[1], k1[0], k1[1]}) > 0)) return false;
    const auto of = [&](int dx, int dy) { return luma_709(still.colour.pixel(x + dx, y + dy)); };
    const float top = of(0, 0) + fx * (of(1, 0) - of(0, 0));
    const float low = of(0, 1) + fx * (of(1, 1) - of(0, 1));
    luma = top + fy * (low - top);
    return true;
}

// `small`, of `box` at 1/d, between its known pixels, over a picture at `origin`.
ImageF1 enlarged(const ImageF1& small, const ImageF1& known, const Recti& box, int d, Vec2i origin,
                 Size size) {
    ImageF1 out(size);
    const auto scale = 1.0f / static_cast<float>(d);
    parallel_rows(size.height, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const float u = (static_cast<float>(x + origin.x) + 0.5f) * scale - 0.5f -
                                static_cast<float>(box.x0);
                const float v = (static_cast<float>(y + origin.y) + 0.5f) * scale - 0.5f -
                                static_cast<float>(box.y0);
                const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
                const float fx = u - static_cast<float>(i), fy = v - static_cast<float>(j);
                float sum = 0, weight = 0;
                for (int k = 0; k < 4; ++k) {
                    const int a = i + k % 2, b = j + k / 2;
                    if (a < 0 || b < 0 || a >= small.width() || b >= small.height()) continue;
                    const float w = known.row(b)[a] * (k % 2 ? fx : 1 - fx) * (k / 2 ? fy : 1 - fy);
                    sum += w * small.row(b)[a], weight += w;
                }
                if (weight > 0) out.row(y)[x] = sum / weight;
            }
        }
    });
    return out;
}

}  // namespace

void StillSurfaceGatherer::add(ViewF3 linear, ViewU8x1 visible, const LatticeField& ref_from_cur) {
    const Reduced frame = reduced({0, 0}, linear, visible, pixel_px_);
    const ImageF2 at = places(frame, pixel_px_, static_cast<float>(pixel_px_), ref_from_cur);
    const Recti box = box_of(at, frame.known, frame.box.size());
    if (!box.empty()) parts_.push_back(splat_frame(frame, at, box));
}

StillSurface StillSurfaceGatherer::finish(float daylight) {
    StillSurface out;
    out.pixel_px = static_cast<float>(pixel_px_);
    if (static_cast<int>(parts_.size()) < kFewestStillFrames) return out;
    for (const Part& part : parts_)
        out.box = out.box.united(part.box);
    Changes changes;
    for (int round = 0; round < kStillLevelRounds; ++round) {
        out.colour = ImageF3(out.box.size());
        out.known = ImageF1(out.box.size());
        ImageF1 middle(out.box.size());
        changes = darkest(parts_, out, middle);
        if (round + 1 == kStillLevelRounds) break;
        for (Part& part : parts_)
            part.level = fast_exp(low_level(part, out.box, middle, out.known));
        std::erase_if(parts_, [](const Part& part) { return part.level < kFadedShare; });
    }
    if (!(changes.places >= static_cast<double>(kFewestPlaces))) return {};
    ImageF1 luma(out.box.size());
    for (int y = 0; y < luma.height(); ++y)
        for (int x = 0; x < luma.width(); ++x)
            luma.row(y)[x] = luma_709(out.colour.pixel(x, y));
    for (const Part& part : parts_)
        out.usual += (low_level(part, out.box, luma, out.known) - fast_log(part.level)) /
                     static_cast<float>(parts_.size());
    out.confidence = confidence_in(changes, added_share(parts_, out, daylight));
    return out;
}

ImageF1 moving_gloss(Vec2i origin, ViewF3 plate, ViewU8x1 matte, const StillSurface& still,
                     const LatticeField& ref_from_cur) {
    if (still.box.empty()) return ImageF1(matte.size());
    const int d = std::max(1, static_cast<int>(std::lround(still.pixel_px)));
    Reduced frame = reduced(origin, plate, matte, d);
    const ImageF2 at = places(frame, d, still.pixel_px, ref_from_cur);
    ImageF1 gloss(frame.box.size()), paint(frame.box.size());
    std::vector<float> ratios;
    for (int y = 0; y < gloss.height(); ++y) {
        for (int x = 0; x < gloss.width(); ++x) {
            float& known = frame.known.row(y)[x];
            if (known == 0) continue;
            if (!look_up_still(still, at.pixel(x, y), paint.row(y)[x])) {
                known = 0;
                continue;
            }
            gloss.row(y)[x] = luma_709(frame.colour.pixel(x, y));
            ratios.push_back(ln_ratio(gloss.row(y)[x], paint.row(y)[x]));
        }
    }
    if (ratios.size() < kFewestPlaces) return ImageF1(matte.size());
    const float level = fast_exp(quantile(ratios, kLowQuarter) - still.usual);
    for (std::size_t i = 0; i < gloss.size_bytes() / sizeof(float); ++i)
        gloss.data()[i] = std::max(0.0f, gloss.data()[i] - level * paint.data()[i]);
    return enlarged(gloss, frame.known, frame.box, d, origin, matte.size());
}

}  // namespace weft
