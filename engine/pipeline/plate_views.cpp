#include "engine/pipeline/plate_views.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/core/luma.h"
#include "engine/core/parallel.h"
#include "engine/mask/matte_box.h"
#include "engine/motion/follow_size.h"

namespace weft {
namespace {

constexpr int kBand = 32;

// NaN becomes 0. Without branches, so that the compiler vectorises it.
std::uint8_t code(float v) {
    const float scaled = v * 255.0f + 0.5f;
    const float above_0 = scaled > 0.0f ? scaled : 0.0f;
    return static_cast<std::uint8_t>(
        static_cast<std::int32_t>(above_0 < 255.0f ? above_0 : 255.0f));
}

}  // namespace

PlateViews make_views(const ImageF3& plate, const ColorTransform& display_from_plate) {
    PlateViews views{
        ImageU8x3(plate.size()), Matte(plate.size()), Matte(plate.size(), 255), {}, {}};
    std::atomic<bool> all_finite{true};
    const bool convert = !display_from_plate.identity();
    parallel_rows(plate.height(), kBand, [&](int y0, int y1) {
        ImageF3 band(plate.width(), convert ? 1 : 0);
        for (int y = y0; y < y1; ++y) {
            const float* in = plate.row(y);
            for (int x = 0; x < plate.width(); ++x) {
                const float* p = in + 3 * x;
                if (!std::isfinite(p[0] + p[1] + p[2])) {
                    views.finite.at(x, y) = 0;
                    all_finite = false;
                }
            }
            if (convert) {
                std::copy(in, in + plate.stride(), band.data());
                display_from_plate.apply(band);
                in = band.data();
            }
            std::uint8_t* out = views.display.row(y);
            std::uint8_t* luma = views.luma.row(y);
            for (int i = 0; i < 3 * plate.width(); ++i)
                out[i] = code(in[i]);
            for (int x = 0; x < plate.width(); ++x, out += 3) {
                luma[x] = static_cast<std::uint8_t>(luma_709_code(out[0], out[1], out[2]));
            }
        }
    });
    if (all_finite) views.finite = {};
    const Size followed = follow_size(plate.size());
    if (followed != plate.size()) {
        views.small_luma = reduced(views.luma, followed);
        views.small_display = std::make_shared<const ImageU8x3>(reduced(views.display, followed));
    }
    return views;
}

ImageF3 transformed(const ImageF3& image, const ColorTransform& transform) {
    if (transform.identity()) return image;
    ImageF3 out(image.size());
    parallel_rows(out.height(), kBand, [&](int y0, int y1) {
        std::copy(image.row(y0), image.row(y0) + (y1 - y0) * image.stride(), out.row(y0));
        transform.apply(out.view().crop({0, y0, out.width(), y1}));
    });
    return out;
}

Matte without_holdout(const Matte& extent, const Matte& holdout) {
    if (holdout.empty()) return extent;
    Matte out(extent.size());
    const std::uint8_t *e = extent.data(), *h = holdout.data();
    std::transform(e, e + extent.size_bytes(), h, out.data(), [](int a, int b) {
        return static_cast<std::uint8_t>((a * (255 - b) + 127) / 255);
    });
    return out;
}

void drop_nonfinite(Matte& mask, const Matte& finite) {
    if (finite.empty()) return;
    std::transform(mask.data(), mask.data() + mask.size_bytes(), finite.data(), mask.data(),
                   [](std::uint8_t m, std::uint8_t f) { return f ? m : std::uint8_t{0}; });
}

Matte cropped(const Matte& matte, const Recti& box) {
    Matte out(box.size());
    for (int y = 0; y < box.height(); ++y) {
        const std::uint8_t* row = matte.pixel(box.x0, box.y0 + y);
        std::copy(row, row + box.width(), out.row(y));
    }
    return out;
}

Recti matte_bounds(ViewU8x1 matte) {
    return matte_box(matte, 1);
}

}  // namespace weft
