#include "engine/lighting/highlights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/core/finite_rgb.h"
#include "engine/core/luma.h"
#include "engine/core/parallel.h"
#include "engine/core/smooth_step.h"
#include "engine/lighting/coverage.h"
#include "engine/lighting/masked_filters.h"
#include "engine/lighting/quantile.h"
#include "engine/lighting/shading_lookup.h"

namespace weft {
namespace {

using Colour = std::array<float, 3>;

constexpr float kPaintQuantile = 0.98f;  // of plate / shading: values above may be gloss
constexpr float kGlossAbove = 1.15f;
constexpr std::size_t kFewestPixels = 64;
constexpr float kDarkShare = 0.2f;     // the darkest pixels, whose colour is noise
constexpr float kBodyQuantile = 0.9f;  // of the saturation
// The sine of the angle between both colours: told apart from kApart on.
constexpr float kAlike = 0.08f, kApart = 0.2f;
// What both colours leave unexplained, of all: several paints from kSeveral on.
constexpr float kOnePaint = 0.05f, kSeveral = 0.12f;
constexpr float kRoughest = 0.03f;  // of the plate's width

// What the colours do not decide.
float rest_of(const SurfaceColours& colours) {
    return 1.0f - colours.confidence;
}

float dot(const Colour& a, const float* b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Colour of_luminance_one(Colour c) {
    const float luma = luma_709(c.data());
    for (float& channel : c)
        channel /= luma;
    return c;
}

// How much of a pixel is body and how much mirrored light, by least squares.
class Parts {
  public:
    explicit Parts(const SurfaceColours& c) : c_(c) {
        const float bb = dot(c.body, c.body.data()), ll = dot(c.light, c.light.data());
        const float bl = dot(c.body, c.light.data());
        const float scale = 1.0f / std::max(1e-6f, bb * ll - bl * bl);
        body_ = {ll * scale, -bl * scale}, light_ = {-bl * scale, bb * scale};
    }
    [[nodiscard]] float body(const float* p) const {
        return body_[0] * dot(c_.body, p) + body_[1] * dot(c_.light, p);
    }
    [[nodiscard]] float light(const float* p) const {
        return light_[0] * dot(c_.body, p) + light_[1] * dot(c_.light, p);
    }

  private:
    const SurfaceColours& c_;
    std::array<float, 2> body_{}, light_{};
};

std::vector<const float*> pixels_of(ViewF3 plate, ViewU8x1 matte) {
    std::vector<const float*> out;
    std::vector<float> lumas;
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x) {
            const float* p = plate.pixel(x, y);
            if (matte.row(y)[x] < kCoveredFrom || !finite_rgb(p)) continue;
            out.push_back(p);
            lumas.push_back(luma_709(p));
        }
    }
    if (out.size() < kFewestPixels) return {};
    const float dark = std::max(quantile(lumas, kDarkShare), 1e-5f);
    std::erase_if(out, [&](const float* p) { return luma_709(p) < dark; });
    return out;
}

float saturation(const float* p) {
    return 1.0f - std::min({p[0], p[1], p[2]}) / std::max({p[0], p[1], p[2], 1e-6f});
}

// The most that can be gloss: nothing negative, and not more than there is of the light's colour.
float mirrored(const Parts& parts, const SurfaceColours& colours, const float* p) {
    float most = std::max(0.0f, parts.light(p));
    for (std::size_t c = 0; c < 3; ++c)
        most = std::min(most, std::max(0.0f, p[c]) / colours.light[c]);
    return most;
}

void roughen(ImageF1& gloss, ViewU8x1 matte, const HighlightOptions& options) {
    const float sigma_px = options.roughness * kRoughest * static_cast<float>(options.plate_width);
    if (!(sigma_px >= 0.3f)) return;
    ImageF1 known(gloss.size());
    for (int y = 0; y < gloss.height(); ++y)
        for (int x = 0; x < gloss.width(); ++x)
            known.row(y)[x] = matte.row(y)[x] >= kCoveredFrom ? 1.0f : 0.0f;
    gloss = weighted(gloss, known);
    gaussian_blur(gloss, sigma_px);
    gaussian_blur(known, sigma_px);
    for (std::size_t i = 0; i < gloss.size_bytes() / sizeof(float); ++i)
        gloss.data()[i] /= std::max(known.data()[i], kLeastWeight);
}

// plate / shading of the brightest paint; empty where too little is seen.
float brightest_paint(ViewF3 plate, ViewU8x1 matte, Vec2i origin, const Shading& shading) {
    std::vector<float> ratios, scratch, light(static_cast<std::size_t>(plate.width()));
    for (int y = 0; y < plate.height(); ++y) {
        shading_row(shading, origin.x, origin.y + y, scratch, light);
        for (int x = 0; x < plate.width(); ++x) {
            const float* p = plate.pixel(x, y);
            const float s = light[static_cast<std::size_t>(x)];
            if (matte.row(y)[x] >= kCoveredFrom && finite_rgb(p) && s > 0)
                ratios.push_back(luma_709(p) / s);
        }
    }
    return ratios.size() < kFewestPixels ? 0.0f : kGlossAbove * quantile(ratios, kPaintQuantile);
}

// The luminance of what is mirrored: by the colours, and for the rest by its motion.
ImageF1 mirrored_light(ViewF3 plate, ViewU8x1 matte, const SurfaceColours& colours,
                       const MovingGloss& moving) {
    const Parts parts(colours);
    const float by_motion = moving.luminance.empty() ? 0.0f : rest_of(colours) * moving.confidence;
    ImageF1 out(matte.size());
    parallel_rows(out.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < out.width(); ++x) {
                const float* p = plate.pixel(x, y);
                if (matte.row(y)[x] == 0 || !finite_rgb(p)) continue;
                float& found = out.row(y)[x];
                if (colours.confidence > 0)
                    found = colours.confidence * mirrored(parts, colours, p);
                if (by_motion > 0) found += by_motion * moving.luminance.row(y)[x];
            }
        }
    });
    return out;
}

// What no motion has shown yet.
void add_excess(ImageF3& gloss, Vec2i origin, ViewF3 plate, ViewU8x1 matte, const Shading& shading,
                const MovingGloss& moving, float amount) {
    if (!(amount > 0)) return;
    const float paint = brightest_paint(plate, matte, origin, shading);
    if (!(paint > 0)) return;
    parallel_rows(gloss.height(), 8, [&](int y0, int y1) {
        std::vector<float> scratch, row(static_cast<std::size_t>(gloss.width()));
        for (int y = y0; y < y1; ++y) {
            shading_row(shading, origin.x, origin.y + y, scratch, row);
            for (int x = 0; x < gloss.width(); ++x) {
                const float* p = plate.pixel(x, y);
                if (matte.row(y)[x] == 0 || !finite_rgb(p)) continue;
                const float luma = luma_709(p);
                float excess = luma - paint * row[static_cast<std::size_t>(x)];
                if (!moving.luminance.empty())
                    excess -= moving.confidence * moving.luminance.row(y)[x];
                if (!(excess > 0)) continue;
                for (int c = 0; c < 3; ++c)
                    gloss.pixel(x, y)[c] += amount * p[c] * (excess / luma);
            }
        }
    });
}

// Of the light's colour, and the share of the body's light that is left without it.
void add_mirrored(Highlights& out, ViewF3 plate, ViewU8x1 matte, const SurfaceColours& colours,
                  const MovingGloss& moving, const HighlightOptions& options) {
    const bool moves = moving.confidence > 0 && !moving.luminance.empty();
    if (!(colours.confidence > 0) && !moves) return;
    const ImageF1 sharp = mirrored_light(plate, matte, colours, moving);
    ImageF1 rough = sharp;
    roughen(rough, matte, options);
    const float taken = std::min(1.0f, options.amount);
    for (int y = 0; y < out.gloss.height(); ++y) {
        for (int x = 0; x < out.gloss.width(); ++x) {
            const float* p = plate.pixel(x, y);
            if (matte.row(y)[x] == 0 || !finite_rgb(p)) continue;
            const float luma = luma_709(p);
            if (luma > 0) out.body.row(y)[x] = 1 - taken * std::min(1.0f, sharp.row(y)[x] / luma);
            for (std::size_t c = 0; c < 3; ++c)
                out.gloss.pixel(x, y)[c] += options.amount * rough.row(y)[x] * colours.light[c];
        }
    }
}

}  // namespace

SurfaceColours surface_colours(ViewF3 plate, ViewU8x1 matte, const Colour& light_tint) {
    SurfaceColours out;
    for (std::size_t c = 0; c < 3; ++c)
        out.light[c] = std::exp(light_tint[c]);
    out.light = of_luminance_one(out.light);
    const std::vector<const float*> pixels = pixels_of(plate, matte);
    if (pixels.empty()) return out;
    std::vector<float> saturations;
    saturations.reserve(pixels.size());
    for (const float* p : pixels)
        saturations.push_back(saturation(p));
    std::vector<float> ordered = saturations;
    const float least = quantile(ordered, kBodyQuantile);
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < pixels.size(); ++i)
        for (std::size_t c = 0; saturations[i] >= least && c < 3; ++c)
            sum[c] += std::max(0.0f, pixels[i][c]);
    for (std::size_t c = 0; c < 3; ++c)
        out.body[c] = static_cast<float>(sum[c]);
    if (!(luma_709(out.body.data()) > 0)) return out;
    out.body = of_luminance_one(out.body);
    const float bl = dot(out.body, out.light.data());
    const float cosine =
        bl / std::sqrt(dot(out.body, out.body.data()) * dot(out.light, out.light.data()));
    const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
    if (!(sine > kAlike)) return out;
    const Parts parts(out);
    double left = 0, all = 0;
    for (const float* p : pixels) {
        const float b = parts.body(p), l = parts.light(p);
        for (std::size_t c = 0; c < 3; ++c) {
            const double r = p[c] - b * out.body[c] - l * out.light[c];
            left += r * r, all += static_cast<double>(p[c]) * p[c];
        }
    }
    const auto unexplained = static_cast<float>(std::sqrt(left / std::max(all, 1e-12)));
    out.confidence =
        smooth_step(sine, kAlike, kApart) * (1.0f - smooth_step(unexplained, kOnePaint, kSeveral));
    return out;
}

Highlights find_highlights(Vec2i origin, ViewF3 plate, ViewU8x1 matte, const Shading& shading,
                           const SurfaceColours& colours, const MovingGloss& moving,
                           const HighlightOptions& options) {
    if (!(options.amount > 0)) return {};
    Highlights out{ImageF3(matte.size()), ImageF1(matte.size(), 1.0f)};
    add_excess(out.gloss, origin, plate, matte, shading, moving, options.amount * rest_of(colours));
    add_mirrored(out, plate, matte, colours, moving, options);
    return out;
}

void add_highlights(ImageView<float, 3> texture, const Highlights& highlights) {
    for (int y = 0; y < highlights.gloss.height(); ++y) {
        for (int x = 0; x < texture.width(); ++x) {
            for (int c = 0; c < 3; ++c) {
                float& v = texture.pixel(x, y)[c];
                v = highlights.body.row(y)[x] * v + highlights.gloss.pixel(x, y)[c];
            }
        }
    }
}

}  // namespace weft
