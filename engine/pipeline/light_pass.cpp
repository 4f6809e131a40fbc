#include "engine/pipeline/light_pass.h"

#include "engine/core/parallel.h"
#include "engine/lighting/clip_reflectance.h"
#include "engine/pipeline/surface_pass.h"

namespace weft {
namespace {

// For each pixel of the downscaled picture, the displacement to the reference frame, in small
// pixels.
ImageF2 small_motion(const LatticeField& ref_from_cur, const SurfaceSample& sample) {
    ImageF2 d(sample.box.size());
    const auto scale = static_cast<float>(sample.downscale);
    parallel_rows(d.height(), 16, [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) {
            for (int x = 0; x < d.width(); ++x) {
                const Vec2 at = scale * Vec2(static_cast<float>(x + sample.box.x0) + 0.5f,
                                             static_cast<float>(y + sample.box.y0) + 0.5f);
                const Vec2 moved = ref_from_cur.at(at) / scale;
                d.pixel(x, y)[0] = moved.x, d.pixel(x, y)[1] = moved.y;
            }
        }
    });
    return d;
}

struct Evidence {
    SurfaceSample sample;
    ImageF2 ref_from_cur;
};

Expected<Evidence> light_evidence_at(const AnalysisStore& store, int region, int frame) {
    WEFT_TRY(sample_bytes, store.get({region, frame, AnalysisKind::kLightSample}));
    WEFT_TRY(sample, decode_light_sample(sample_bytes));
    WEFT_TRY(field_bytes, store.get({region, frame, AnalysisKind::kCoords}));
    WEFT_TRY(field, decode_lattice(field_bytes));
    ImageF2 motion = small_motion(field, sample);
    return Evidence{std::move(sample), std::move(motion)};
}

Status light_at(const PassContext& context, AnalysisStore& store, int region, int frame,
                const ClipReflectance& reflectance) {
    if (context.cancel.cancelled()) return cancelled(context.cancel);
    WEFT_TRY(at, light_evidence_at(store, region, frame));
    const ShadingOptions options = shading_options(context.plan, context.source.size());
    const Shading shading = shading_with(at.sample, reflectance, at.ref_from_cur, options);
    return store.put({region, frame, AnalysisKind::kShading}, encode(shading));
}

}  // namespace

Status estimate_light(const PassContext& context, int region, FrameSpan span,
                      AnalysisStore& store) {
    ReflectanceGatherer gatherer(shading_options(context.plan, context.source.size()));
    for (const int frame : context.plan.regions[static_cast<std::size_t>(region)].light_evidence) {
        if (context.cancel.cancelled()) return cancelled(context.cancel);
        WEFT_TRY(at, light_evidence_at(store, region, frame));
        gatherer.add(at.sample, at.ref_from_cur);
    }
    const ClipReflectance reflectance = gatherer.finish();
    const int frames = span.last - span.first + 1;
    return parallel_try(static_cast<std::size_t>(frames), [&](std::size_t k) {
        const int frame = span.first + static_cast<int>(k);
        return light_at(context, store, region, frame, reflectance);
    });
}

}  // namespace weft
