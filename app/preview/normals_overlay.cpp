#include "app/preview/normals_overlay.h"

#include <algorithm>

#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_form.h"

namespace weft {
namespace {

// Of the colours over the plate, so that the surface stays recognisable.
constexpr float kOpacity = 0.85f;

std::uint8_t code_of(float v) {
    return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
}

}  // namespace

Status draw_normals(const Shot& shot, const RegionScene& scene, const AnalysisStore& store,
                    int region, OverlayPicture& out) {
    if (!scene.form) return {};
    const Recti box = rect_of(out.where.size());
    WEFT_TRY(form, region_form_on(scene, store, region, out.frame, out.where, box));
    WEFT_TRY(plate, shot.source->plate(out.frame));
    const ImageF3 shown = transformed(*plate, *shot.plan.display_from_plate);
    ImageU8x3 colours(out.where.size());
    for (int y = 0; y < colours.height(); ++y) {
        for (int x = 0; x < colours.width(); ++x) {
            const bool known = form.confidence.at(x, y) > 0;
            const float cover =
                known ? kOpacity * static_cast<float>(out.where.at(x, y)) / 255.0f : 0.0f;
            for (int c = 0; c < 3; ++c) {
                const float normal = 0.5f + 0.5f * form.normal.at(x, y, c);
                const float under = shown.pixel(x, y)[c];
                colours.pixel(x, y)[c] = code_of(under + cover * (normal - under));
            }
        }
    }
    out.colours = make_picture(std::move(colours));
    return {};
}

}  // namespace weft
