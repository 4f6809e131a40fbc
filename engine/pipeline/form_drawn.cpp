#include "engine/pipeline/form_drawn.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/core/setting.h"
#include "engine/core/unsqueezed_image.h"
#include "engine/form/drawn_form.h"
#include "engine/form/flat_plane.h"
#include "engine/form/flatten.h"
#include "engine/form/form_level.h"
#include "engine/form/form_relief.h"
#include "engine/mask/matte_box.h"
#include "engine/pipeline/form_laid.h"
#include "engine/pipeline/plate_views.h"

namespace weft {
namespace {

// Adds the surface at the pixels of the matte that show it.
void add_surface(MetricField& field, const DrawnSurface& surface, const Matte& visible) {
    const int step = std::max(1, field.spacing() / 4);
    for (int y = step / 2; y < visible.height(); y += step) {
        for (int x = step / 2; x < visible.width(); x += step) {
            if (visible.row(y)[x] < 128) continue;
            const Vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const auto metric = surface.metric(at);
            if (!metric) continue;
            const double cosine = facing(*metric);
            if (cosine > 0) field.add(at, *metric, cosine * cosine);
        }
    }
}

// Over the matte and what lies around it: of a plane as far as half a plate, so that what comes
// into the picture has its place; of a round thing a little.
Recti domain_of(const Recti& box, Size plate, bool plane) {
    const int plates = std::max(plate.width, plate.height);
    const int side = std::max(box.width(), box.height());
    return box.grown(plane ? std::min(plates / 2, side) : std::min(plates / 2, side / 4 + 8));
}

FormMap laid(const DrawnSurface& surface, const MetricField& field, const Matte& visible) {
    if (!surface.is_plane()) return flat_from_reference(field);
    const SeenPlane plane{std::get<DrawnPlane>(surface.body).normal, surface.camera};
    double least = std::numeric_limits<double>::infinity();
    for (int y = 0; y < visible.height(); ++y) {
        for (int x = 0; x < visible.width(); ++x) {
            const Vec2 at = centre_of_pixel(x, y);
            if (visible.row(y)[x] >= 128 && surface.metric(at))
                least = std::min(least, plane.nearness(at));
        }
    }
    return flat_plane(plane, kGoesOn * least, field);
}

}  // namespace

Expected<FormMap> form_from_drawing(const FormEvidence& evidence, Size plate,
                                    const RegionPlan& region) {
    const DrawnCamera camera{plate, region.form_fov_deg};
    WEFT_CHECK_OK(check_drawn_form(region.form_guides, camera, evidence.visible));
    WEFT_TRY(surface, surface_of_guides(region.form_guides, camera));
    const Recti box = matte_box(evidence.visible);
    MetricField field = field_over(plate, domain_of(box, plate, surface.is_plane()));
    add_surface(field, surface, evidence.visible);
    MetricField::Beyond beyond;
    if (surface.is_plane()) beyond = [&](Vec2 place) { return surface.metric(place); };
    if (!field.finish(beyond))
        return fail(ErrorCode::kUsage,
                    "The region shows too little of the shape on its reference frame.",
                    "Draw it over the surface" + by({{setting::kFormShape}}) + ".");
    FormMap out = laid(surface, field, evidence.visible);
    out.finding = {FormFinding::Source::kShape,
                   surface.is_plane(),
                   1,
                   1.0f,
                   static_cast<float>(surface.tilt_deg),
                   static_cast<float>(surface.tilt_error_deg),
                   static_cast<float>(surface.fov_deg)};
    add_relief(out, field, surface.fov_deg, plate, surface.is_plane());
    return out;
}

Status level_form(const FormEvidence& evidence, const RegionPlan& region, FormMap& form) {
    if (form.finding.source == FormFinding::Source::kNone) return {};
    const auto is_level = [](const FormGuide& guide) {
        return guide.kind == FormGuideKind::kLevel;
    };
    if (std::none_of(region.form_guides.begin(), region.form_guides.end(), is_level)) return {};
    WEFT_CHECK_OK(check_strokes(region.form_guides, FormGuideKind::kLevel, evidence.visible));
    const Recti box = matte_box(evidence.visible);
    turn_level(
        form, region.form_guides,
        0.5f * Vec2(static_cast<float>(box.x0 + box.x1), static_cast<float>(box.y0 + box.y1)));
    return {};
}

Status check_drawn_forms(const ShotSource& source, const ShotPlan& plan) {
    for (int k = 0; k < static_cast<int>(plan.regions.size()); ++k) {
        const RegionPlan& region = plan.regions[static_cast<std::size_t>(k)];
        if (region.form_from != RegionPlan::FormFrom::kShape) continue;
        const int frame = region.reference_frames.front();
        const bool painted = region.propagated();
        if (painted &&
            !std::binary_search(region.matte_keys.begin(), region.matte_keys.end(), frame))
            continue;
        WEFT_TRY(extent, painted ? source.matte_key(k, frame) : source.matte(k, frame));
        WEFT_TRY(given, source.holdout(k, frame));
        const Matte visible = unsqueezed(
            given ? without_holdout(extent, *given) : std::move(extent), region.placement.aspect);
        WEFT_CHECK_OK(
            check_drawn_form(region.form_guides, {visible.size(), region.form_fov_deg}, visible));
    }
    return {};
}

}  // namespace weft
