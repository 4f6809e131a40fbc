#include "engine/lighting/light_doubt.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/lighting/masked_filters.h"

namespace weft {
namespace {

// Of the pattern's size: what is finer is paint, what is wider is light, and the window in which
// the amplitude is taken.
constexpr float kFine = 0.5f, kWide = 3.5f, kAround = 0.75f;
// Amplitudes (ln units), measured on rendered scenes in draft: light is off by 15 % and more on
// 2 % of the places below 0.1, on 30 % of those about 0.4 and on half of those above 0.6.
constexpr float kSure = 0.05f, kLost = 0.6f;

class Mean {
  public:
    Mean(const ImageF1& weight, float sigma) : weight_(weight), sigma_(sigma), total_(weight) {
        gaussian_blur(total_, sigma_);
    }
    [[nodiscard]] ImageF1 of(const ImageF1& plane) const {
        ImageF1 out = weighted(plane, weight_);
        gaussian_blur(out, sigma_);
        for (std::size_t i = 0; i < out.size_bytes() / sizeof(float); ++i)
            out.data()[i] /= std::max(total_.data()[i], kLeastWeight);
        return out;
    }

  private:
    const ImageF1& weight_;
    float sigma_;
    ImageF1 total_;
};

}  // namespace

ImageF1 light_doubt(const ImageF1& light, const ImageF1& paint, const ImageF1& weight,
                    float pattern_px) {
    const Mean fine(weight, kFine * pattern_px), wide(weight, kWide * pattern_px),
        around(weight, kAround * pattern_px);
    const auto amplitude = [&](const ImageF1& plane) {
        ImageF1 middle = fine.of(plane);
        const ImageF1 broad = wide.of(plane);
        for (std::size_t i = 0; i < middle.size_bytes() / sizeof(float); ++i) {
            const float d = middle.data()[i] - broad.data()[i];
            middle.data()[i] = d * d;
        }
        return around.of(middle);
    };
    ImageF1 out = amplitude(light);
    const ImageF1 other = amplitude(paint);
    for (std::size_t i = 0; i < out.size_bytes() / sizeof(float); ++i) {
        out.data()[i] =
            std::sqrt(std::max(0.0f, out.data()[i])) + std::sqrt(std::max(0.0f, other.data()[i]));
    }
    return out;
}

ImageF1 light_doubt(const SurfaceSample& sample, const LogShading& log,
                    const ShadingOptions& options) {
    ImageF1 light = log.value, paint = sample.luma;
    for (std::size_t i = 0; i < paint.size_bytes() / sizeof(float); ++i)
        paint.data()[i] -= log.value.data()[i];
    for (std::size_t i = 0; i < sample.daylight.size_bytes() / sizeof(float); ++i)
        light.data()[i] -= sample.daylight.data()[i];
    for (std::size_t i = 0; i < sample.paint.size_bytes() / sizeof(float); ++i)
        paint.data()[i] -= sample.paint.data()[i];
    return light_doubt(light, paint, log.pattern.ground,
                       std::max(1.0f, options.pattern_px / static_cast<float>(sample.downscale)));
}

void note_doubt(Shading& shading, const SurfaceSample& sample, const ImageF1& doubt) {
    shading.sure = Matte(shading.value.size());
    parallel_rows(sample.box.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < sample.box.width(); ++x) {
                if (sample.weight.row(y)[x] == 0) continue;
                const float sure = 1.0f - smooth_step(doubt.row(y)[x], kSure, kLost);
                // Above 0, which marks where there is no surface.
                shading.sure.row(y + sample.box.y0)[x + sample.box.x0] =
                    static_cast<std::uint8_t>(1.0f + 254.0f * sure + 0.5f);
            }
        }
    });
}

}  // namespace weft
