#include "engine/mask/plate_edge.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mask/boundary_refiner.h"
#include "engine/mask/hidden_part.h"
#include "engine/mask/matte_box.h"
#include "engine/mask/signed_distance.h"
#include "engine/mask/soft_matting.h"
#include "engine/motion/follow_size.h"

namespace weft {
namespace {

constexpr float kLimitPx = 24;       // of the smaller matte: signed distances
constexpr float kBandPx = 1.5f;      // of the smaller matte: how far its boundary may be off
constexpr float kWidestEdgePx = 20;  // of its soft ones

ImageF1 boundary_of(ViewU8x1 matte) {
    ImageF1 phi = smooth_distance(signed_distance(inside_of(matte), kLimitPx), 2);
    place_by_coverage(phi, matte);
    return phi;
}

// Between the pixels of a smaller picture and those of a larger one.
struct Enlargement {
    Enlargement(Size small, Size large)
        : per_x(static_cast<float>(small.width) / static_cast<float>(large.width)),
          per_y(static_cast<float>(small.height) / static_cast<float>(large.height)) {}

    // Where the centre of a pixel of the larger one lies among the centres of the smaller one's.
    [[nodiscard]] Vec2 place(int x, int y) const {
        return {(static_cast<float>(x) + 0.5f) * per_x - 0.5f,
                (static_cast<float>(y) + 0.5f) * per_y - 0.5f};
    }
    [[nodiscard]] float gain() const { return 2 / (per_x + per_y); }

    float per_x, per_y;
};

// `area` of the enlarged field, times `gain`.
ImageF1 enlarged_part(ViewF1 small, const Enlargement& by, const Recti& area, float gain) {
    ImageF1 out(area.size());
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const Vec2 p = by.place(area.x0 + x, area.y0 + y);
                out.at(x, y) = gain * sample_bilinear(small, p.x, p.y);
            }
        }
    });
    return out;
}

ImageF1 as_floats(ViewU8x1 matte) {
    ImageF1 out(matte.size());
    for (int y = 0; y < out.height(); ++y)
        std::copy(matte.row(y), matte.row(y) + out.width(), out.row(y));
    return out;
}

// Where the plate may show any of the matte.
Recti area_of(ViewU8x1 small, const Enlargement& by, Size large) {
    const Recti box = matte_box(small, 1);
    if (box.empty()) return box;
    constexpr float kMargin = 2 * kBandPx + 1;
    const auto at = [&](int v, float per, float more) {
        return static_cast<int>(std::lround((static_cast<float>(v) + more) / per));
    };
    return Recti{at(box.x0, by.per_x, -kMargin), at(box.y0, by.per_y, -kMargin),
                 at(box.x1, by.per_x, kMargin), at(box.y1, by.per_y, kMargin)}
        .intersected(rect_of(large));
}

// The scale of a cut that moves a boundary by `band_px` at most.
RefineScale scale_of(Size frame, float band_px) {
    RefineScale scale(frame);
    scale.band_px = band_px;
    scale.limit_px = 4 * band_px;
    return scale;
}

RefinedBoundary cut_again(ViewU8x3 part, const ImageF1& expected, const RefineScale& scale,
                          const Matte& hidden, float steadiness) {
    std::vector<ColorWindow> windows = place_windows(expected, scale.window_step_px);
    for (ColorWindow& w : windows)
        w.source_centers = {w.center};
    const ImageF1 seen = hidden.empty() ? ImageF1() : seen_distance(expected, hidden);
    LocalColorField colors(std::move(windows),
                           {{part, hidden.empty() ? expected : seen, scale.band_px, 1.0f, 1.0f}},
                           scale.window_half_px, scale.sample_stride, part.size());
    colors.leave_out(hidden);
    ImageF1 near, wide;
    if (!hidden.empty()) {
        near = wide = ImageF1(part.size());
        keep_hidden(near, wide, expected, hidden, {0, 0});
    }
    return refine_boundary(part, expected, colors, near, ViewF1(), scale, steadiness);
}

}  // namespace

Size matte_size(Size plate) {
    return bounded_size(plate, std::int64_t{1920} * 1080);
}

Matte at_plate_size(ViewU8x1 small, ViewU8x3 frame, ViewU8x1 in_front,
                    const MatteOptions& options) {
    Matte out(frame.size());
    const Enlargement by(small.size(), frame.size());
    const Recti area = area_of(small, by, frame.size());
    if (area.empty()) return out;
    const ImageF1 phi = boundary_of(small);
    const float band_px = kBandPx * by.gain() + 1;
    const ImageF1 expected = enlarged_part(phi, by, area, by.gain());
    const ViewU8x3 part = frame.crop(area);
    const Matte hidden = in_front.empty() ? Matte() : hidden_part(in_front.crop(area));
    RefinedBoundary found =
        cut_again(part, expected, scale_of(frame.size(), band_px), hidden, options.steadiness);
    if (options.soft_edges) {
        const ImageF1 softness = enlarged_part(
            edge_softness(small, shape_without_strands(phi, 2 * kWidestEdgePx), kWidestEdgePx), by,
            area, by.gain());
        const ImageF1 coverage = enlarged_part(as_floats(small), by, area, 1);
        Matte known(area.size());
        for (int y = 0; y < known.height(); ++y)
            for (int x = 0; x < known.width(); ++x)
                known.at(x, y) = static_cast<std::uint8_t>(std::lround(coverage.at(x, y)));
        found.matte = with_soft_edges(part, found.phi, softness, std::move(found.matte), known, 1);
    }
    for (int y = 0; y < area.height(); ++y)
        std::copy(found.matte.row(y), found.matte.row(y) + area.width(),
                  out.pixel(area.x0, area.y0 + y));
    return out;
}

Matte enlarged(const Matte& matte, Vec2 gain, Size to) {
    if (matte.size() == to) return matte;
    Matte out(to);
    const float steepness = 0.5f * (gain.x + gain.y);
    // The place between two pixels' centres, and how far it is from the first.
    const auto place = [](int at, float per, int length) {
        const float p = std::clamp((static_cast<float>(at) + 0.5f) / per - 0.5f, 0.0f,
                                   static_cast<float>(length - 1));
        const int first = std::min(static_cast<int>(p), std::max(0, length - 2));
        return std::pair(first, p - static_cast<float>(first));
    };
    parallel_rows(to.height, 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            const auto [j, v] = place(y, gain.y, matte.height());
            const std::uint8_t *a = matte.row(j),
                               *b = matte.row(std::min(j + 1, matte.height() - 1));
            for (int x = 0; x < to.width; ++x) {
                const auto [i, u] = place(x, gain.x, matte.width());
                const int k = std::min(i + 1, matte.width() - 1);
                const auto mean = [&, i = i, u = u](const std::uint8_t* row) {
                    return (1 - u) * static_cast<float>(row[i]) + u * static_cast<float>(row[k]);
                };
                const float code = (1 - v) * mean(a) + v * mean(b);
                const float steep = 127.5f + steepness * (code - 127.5f);
                out.at(x, y) =
                    static_cast<std::uint8_t>(std::lround(std::clamp(steep, 0.0f, 255.0f)));
            }
        }
    });
    return out;
}

}  // namespace weft
