#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/core/luma.h"
#include "engine/core/median.h"
#include "engine/core/parallel.h"
#include "engine/lighting/masked_filters.h"
#include "engine/lighting/shading.h"

namespace weft {
namespace {

constexpr int kPictureDownscale = 2;
constexpr float kDarkest = 1e-5f;  // a shading is above 0

// Mean luminance of the finite pixels of [x0, x1) × [y0, y1) of the picture, at least one pixel;
// negative if none is finite.
float mean_luminance(ViewF3 picture, float x0, float y0, float x1, float y1) {
    const int a = std::clamp(static_cast<int>(x0), 0, picture.width() - 1);
    const int b = std::clamp(static_cast<int>(std::ceil(x1)), a + 1, picture.width());
    const int c = std::clamp(static_cast<int>(y0), 0, picture.height() - 1);
    const int e = std::clamp(static_cast<int>(std::ceil(y1)), c + 1, picture.height());
    float sum = 0, count = 0;
    for (int y = c; y < e; ++y) {
        for (int x = a; x < b; ++x) {
            const float* p = picture.pixel(x, y);
            const float light = luma_709(p);
            if (!std::isfinite(light)) continue;
            sum += light, count += 1;
        }
    }
    return count > 0 ? sum / count : -1.0f;
}

bool any_visible(ViewU8x1 visible, int x0, int y0, int d) {
    for (int y = y0; y < std::min(visible.height(), y0 + d); ++y) {
        for (int x = x0; x < std::min(visible.width(), x0 + d); ++x) {
            if (visible.row(y)[x] >= 128) return true;
        }
    }
    return false;
}

// Fills the shading with `value(x, y)`. Values that are negative or not finite are unknown and
// filled from their surroundings; without a known value there is no light. `band`: rows that one
// thread takes at a time.
template <class Value>
void measure(Shading& shading, int band, const Value& value) {
    const Size size = shading.value.size();
    Matte known(size);
    parallel_rows(size.height, band, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const float light = value(x, y);
                if (!(std::isfinite(light) && light >= 0)) continue;
                shading.value.row(y)[x] = light;
                known.row(y)[x] = 255;
            }
        }
    });
    fill_unknown(shading.value, known);
    for (std::size_t i = 0; i < shading.value.size_bytes() / sizeof(float); ++i)
        shading.value.data()[i] = std::max(kDarkest, shading.value.data()[i]);
}

template <class Value>
Shading full_shading(Size size, const Value& value) {
    Shading shading{ImageF1(size, 1.0f), 1, size};
    if (!size.empty()) measure(shading, 16, value);
    return shading;
}

// A pass that is black where the plate is not does not cover that place.
constexpr float kLitPlate = 0.02f;

}  // namespace

Shading shading_from_lighting(ViewF3 lighting, ViewF3 linear_plate) {
    return full_shading(lighting.size(), [&](int x, int y) {
        const float light = luma_709(lighting.pixel(x, y));
        return light > 0 || luma_709(linear_plate.pixel(x, y)) < kLitPlate ? light : -1.0f;
    });
}

Shading shading_from_albedo(ViewF3 linear_plate, ViewF3 albedo) {
    constexpr float kBlack = 0.004f;  // an 8-bit albedo is not reliable below
    return full_shading(linear_plate.size(), [&](int x, int y) {
        const float paint = luma_709(albedo.pixel(x, y));
        return paint > kBlack ? luma_709(linear_plate.pixel(x, y)) / paint : -1.0f;
    });
}

float median_shading(const Shading& shading, ViewU8x1 visible) {
    std::vector<float> values;
    bool dark = false;
    for (int y = 0; y < shading.value.height(); ++y) {
        for (int x = 0; x < shading.value.width(); ++x) {
            if (!any_visible(visible, x * shading.downscale, y * shading.downscale,
                             shading.downscale))
                continue;
            const float light = shading.value.row(y)[x];
            if (light > kDarkest)
                values.push_back(light);
            else
                dark = true;
        }
    }
    return median_of(values, dark ? kDarkest : 1.0f);
}

Shading shading_from_image(ViewF3 linear_picture, const Recti& box, Size full) {
    constexpr int d = kPictureDownscale;
    const Size small{(full.width + d - 1) / d, (full.height + d - 1) / d};
    Shading shading{ImageF1(small, 1.0f), d, full};
    if (linear_picture.empty() || box.empty() || small.empty()) return shading;
    const float step_x =
        static_cast<float>(linear_picture.width()) / static_cast<float>(box.width());
    const float step_y =
        static_cast<float>(linear_picture.height()) / static_cast<float>(box.height());
    measure(shading, 8, [&](int x, int y) {
        const float left = static_cast<float>(x * d - box.x0) * step_x;
        const float top = static_cast<float>(y * d - box.y0) * step_y;
        return mean_luminance(linear_picture, left, top, left + d * step_x, top + d * step_y);
    });
    return shading;
}

}  // namespace weft
