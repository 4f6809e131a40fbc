#include "engine/lighting/plate_detail.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/core/luma.h"
#include "engine/core/parallel.h"
#include "engine/lighting/fast_math.h"
#include "engine/lighting/masked_filters.h"
#include "engine/lighting/shading_lookup.h"

namespace weft {
namespace {

// Sizes on a plate 960 px wide.
constexpr float kPlateWidth_px = 960.0f;
constexpr float kBroad_px = 28.0f;  // σ: what is finer is not broad light
constexpr float kFine_px = 8.0f;    // σ: what is finer is detail of the surface
constexpr float kNoise_px = 1.0f;   // radius of the mean that takes out grain
constexpr std::uint8_t kSolid = 250;
constexpr float kUnlit = 1e-4f;
constexpr float kMostDetail = 1.5f;  // ln units

float scaled_px(float size_px, int plate_width) {
    return size_px * static_cast<float>(plate_width) / kPlateWidth_px;
}

// Over a box of the plate, in ln: the shading, the plate's luminance at the shading's level, and
// where that is known.
struct LogLight {
    ImageF1 shading, plate, known;
};

// A mean over the known pixels; where there is none near by, `otherwise`.
template <class Blur>
ImageF1 masked_mean(const ImageF1& plane, const ImageF1& known, const ImageF1& otherwise,
                    const Blur& blur) {
    ImageF1 sum = weighted(plane, known), weight = known;
    blur(sum), blur(weight);
    for (std::size_t i = 0; i < sum.size_bytes() / sizeof(float); ++i) {
        float& v = sum.data()[i];
        v = weight.data()[i] > 1e-3f ? v / weight.data()[i] : otherwise.data()[i];
    }
    return sum;
}

// Brings the plate's light to the level of the shading: the paint's mean is not light.
void level(LogLight& light) {
    double difference = 0, count = 0;
    for (std::size_t i = 0; i < light.known.size_bytes() / sizeof(float); ++i) {
        if (!(light.known.data()[i] > 0)) continue;
        difference += static_cast<double>(light.plate.data()[i]) - light.shading.data()[i];
        count += 1;
    }
    const float paint = count > 0 ? static_cast<float>(difference / count) : 0.0f;
    for (std::size_t i = 0; i < light.plate.size_bytes() / sizeof(float); ++i)
        light.plate.data()[i] -= paint;
}

// `linear` is the whole plate, `matte` covers the box at `origin`; a null shading counts as 1.
LogLight log_light(const Shading* shading, ViewF3 linear, ViewU8x1 matte, Vec2i origin) {
    const Size size = matte.size();
    LogLight out{ImageF1(size), ImageF1(size), ImageF1(size)};
    parallel_rows(size.height, 16, [&](int y0, int y1) {
        std::vector<float> scratch, row(static_cast<std::size_t>(size.width));
        for (int y = y0; y < y1; ++y) {
            if (shading) shading_row(*shading, origin.x, origin.y + y, scratch, row);
            for (int x = 0; x < size.width; ++x) {
                const float s = row[static_cast<std::size_t>(x)];
                out.shading.row(y)[x] = shading && s > kUnlit ? fast_log(s) : 0.0f;
                const float* p = linear.pixel(origin.x + x, origin.y + y);
                const float luma = luma_709(p);
                if (matte.row(y)[x] < kSolid || !std::isfinite(luma) || !(luma > kUnlit)) continue;
                out.plate.row(y)[x] = fast_log(luma);
                out.known.row(y)[x] = 1;
            }
        }
    });
    level(out);
    const int radius =
        std::max(1, static_cast<int>(std::lround(scaled_px(kNoise_px, linear.width()))));
    out.plate = masked_mean(out.plate, out.known, out.shading,
                            [&](ImageF1& plane) { box_blur(plane, radius); });
    return out;
}

Shading at_full_size(const Shading& shading, Size full) {
    Shading out{ImageF1(full), 1, full, {}};
    parallel_rows(full.height, 16, [&](int y0, int y1) {
        std::vector<float> scratch, row(static_cast<std::size_t>(full.width));
        for (int y = y0; y < y1; ++y) {
            shading_row(shading, 0, y, scratch, row);
            std::copy(row.begin(), row.end(), out.value.row(y));
        }
    });
    return out;
}

}  // namespace

Shading with_light_detail(const Shading& shading, ViewF3 linear, ViewU8x1 visible, const Recti& box,
                          ViewF1 amount) {
    Shading out = at_full_size(shading, linear.size());
    if (box.empty()) return out;
    const LogLight light = log_light(&shading, linear, visible.crop(box), {box.x0, box.y0});
    const float sigma_px = scaled_px(kBroad_px, linear.width());
    const ImageF1 broad = masked_mean(light.shading, light.known, light.shading,
                                      [&](ImageF1& plane) { gaussian_blur(plane, sigma_px); });
    for (int y = 0; y < box.height(); ++y) {
        for (int x = 0; x < box.width(); ++x) {
            const float step =
                2 * (std::clamp(amount.row(box.y0 + y)[box.x0 + x], 0.0f, 1.0f) - kEstimatedDetail);
            if (visible.row(box.y0 + y)[box.x0 + x] == 0 || step == 0) continue;
            const float own = light.shading.row(y)[x];
            const float towards = step > 0 ? light.plate.row(y)[x] : broad.row(y)[x];
            out.value.row(box.y0 + y)[box.x0 + x] =
                fast_exp(own + std::abs(step) * (towards - own));
        }
    }
    return out;
}

void keep_plate_detail(ImageView<float, 3> texture, Vec2i origin, ViewF3 linear, ViewU8x1 matte,
                       const Shading* shading, float amount) {
    if (!(amount > 0)) return;
    const LogLight light = log_light(shading, linear, matte, origin);
    ImageF1 left(matte.size());
    for (std::size_t i = 0; i < left.size_bytes() / sizeof(float); ++i)
        left.data()[i] = light.plate.data()[i] - light.shading.data()[i];
    const float sigma_px = scaled_px(kFine_px, linear.width());
    const ImageF1 broad = masked_mean(left, light.known, left,
                                      [&](ImageF1& plane) { gaussian_blur(plane, sigma_px); });
    for (int y = 0; y < texture.height(); ++y) {
        for (int x = 0; x < texture.width(); ++x) {
            if (matte.row(y)[x] == 0) continue;
            const float detail =
                std::clamp(left.row(y)[x] - broad.row(y)[x], -kMostDetail, kMostDetail);
            const float factor = fast_exp(amount * detail);
            for (int c = 0; c < 3; ++c)
                texture.pixel(x, y)[c] *= factor;
        }
    }
}

}  // namespace weft
