#include "app/preview/preview_stages.h"

#include <algorithm>

#include "engine/color/color_space.h"
#include "engine/metrics/seam_visibility.h"
#include "engine/pipeline/render_frame.h"

namespace weft {
namespace {

// Shows touched pixels only, on a dark background, because a stage is not a composite.
void isolate(ImageF3& pixels, const Matte& touched) {
    constexpr float kGround = 0.1f;
    for (int y = 0; y < pixels.height(); ++y) {
        for (int x = 0; x < pixels.width(); ++x) {
            const float a = static_cast<float>(touched.at(x, y)) / 255.0f;
            for (int c = 0; c < 3; ++c)
                pixels.pixel(x, y)[c] = kGround + a * (pixels.pixel(x, y)[c] - kGround);
        }
    }
}

float nearest_of(const ImageF1& depth) {
    float out = 0;
    for (int y = 0; y < depth.height(); ++y)
        for (int x = 0; x < depth.width(); ++x)
            if (const float d = depth.at(x, y); d > 0 && (!(out > 0) || d < out)) out = d;
    return out;
}

// A layer of one channel; depth as nearness, white where it is nearest.
float grey_of(const FrameLayers& layers, LayerKind kind, int x, int y, float nearest) {
    if (kind == LayerKind::kSeam) return layers.seam.at(x, y);
    if (kind == LayerKind::kLightConfidence) return layers.light_confidence.at(x, y);
    if (kind == LayerKind::kFormConfidence) return layers.form.confidence.at(x, y);
    if (kind != LayerKind::kDepth) return layers.alpha.at(x, y);
    const float depth = layers.form.depth.at(x, y);
    return depth > 0 ? nearest / depth : 0;
}

// Converts a layer for viewing: colours as displayed, data as grey or red and green.
PicturePtr layer_picture(const FrameLayers& layers, LayerKind kind,
                         const ColorTransform& out_from_working, const MakePicture& picture) {
    const Size size = layers.alpha.size();
    const ImageF3* const colours = kind == LayerKind::kPatch     ? &layers.patch
                                   : kind == LayerKind::kEdge    ? &layers.edge
                                   : kind == LayerKind::kLight   ? &layers.light
                                   : kind == LayerKind::kGloss   ? &layers.gloss
                                   : kind == LayerKind::kTexture ? &layers.texture
                                   : kind == LayerKind::kFinish  ? &layers.finish
                                                                 : nullptr;
    if (colours) {
        ImageF3 pixels = *colours;
        // A gain of 1 is neutral and shown as middle grey.
        constexpr float kMiddle = 0.18f;
        if (kind == LayerKind::kLight)
            for (std::size_t i = 0; i < pixels.size_bytes() / sizeof(float); ++i)
                pixels.data()[i] *= kMiddle;
        out_from_working.apply(pixels);
        return picture(pixels);
    }
    ImageU8x3 data(size);
    const float nearest = nearest_of(layers.form.depth);
    const auto code = [](float v) {
        return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
    };
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            std::uint8_t* out = data.pixel(x, y);
            if (kind == LayerKind::kSt) {
                const float* st = layers.st.pixel(x, y);
                out[0] = code(st[0]), out[1] = code(st[1]), out[2] = 0;
            } else if (kind == LayerKind::kId) {
                // Ids are small numbers; each gets its own colour.
                const auto id = static_cast<std::uint32_t>(layers.id.at(x, y));
                const std::uint32_t mixed = id * 2654435761u;
                for (int c = 0; c < 3; ++c)
                    out[c] = id == 0 ? 0 : static_cast<std::uint8_t>(64 + (mixed >> (8 * c)) % 192);
            } else if (kind == LayerKind::kNormal) {
                // 0.5 + 0.5 n, as normals are usually shown.
                const bool known = layers.form.confidence.at(x, y) > 0;
                for (int c = 0; c < 3; ++c)
                    out[c] = known ? code(0.5f + 0.5f * layers.form.normal.at(x, y, c)) : 0;
            } else {
                out[0] = out[1] = out[2] = code(grey_of(layers, kind, x, y, nearest));
            }
        }
    }
    return make_picture(std::move(data));
}

}  // namespace

Expected<PreviewFrame> render_stages(const StageInputs& in, int frame, bool stages,
                                     std::optional<LayerKind> layer, const MakePicture& picture,
                                     float* seam) {
    PreviewFrame out;
    ShotPlan plan = in.plan;
    plan.layers = seam || layer;
    plan.form_layers = layer && shows_form(*layer);
    WEFT_TRY(lit, render_frame(in.source, plan, in.scenes, in.store, in.backend, frame));
    out.stages[static_cast<std::size_t>(Stage::kFinal)] = picture(lit.pixels);
    if (seam) {
        *seam = lit.layers ? seam_visibility(lit.pixels, lit.touched, lit.layers->seam) : -1;
        out.seams = std::make_shared<const SeamPoints>(seam_points(lit));
    }
    if (layer && lit.layers) {
        out.layer_kind = layer;
        out.layer = layer_picture(*lit.layers, *layer, *plan.out_from_working, picture);
    }
    plan.layers = false;
    if (!stages) return out;
    isolate(lit.pixels, lit.touched);
    out.stages[static_cast<std::size_t>(Stage::kLit)] = picture(lit.pixels);
    ShotPlan dark = plan;
    for (RegionPlan& region : dark.regions)
        region.light_source = LightSource::kNone;
    WEFT_TRY(flat, render_frame(in.source, dark, in.scenes, in.store, in.backend, frame));
    isolate(flat.pixels, flat.touched);
    out.stages[static_cast<std::size_t>(Stage::kTexture)] = picture(flat.pixels);
    return out;
}

}  // namespace weft
