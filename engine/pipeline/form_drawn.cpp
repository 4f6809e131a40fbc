#include "engine/pipeline/form_drawn.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/setting.h"
#include "engine/form/drawn_surface.h"
#include "engine/form/flatten.h"
#include "engine/form/form_level.h"
#include "engine/form/form_relief.h"
#include "engine/mask/matte_box.h"

namespace weft {
namespace {

constexpr int kAlong = 17;  // places of a stroke that are looked at

bool shows(const Matte& matte, glm::dvec2 place) {
    return place.x >= 0 && place.y >= 0 && place.x < matte.width() && place.y < matte.height() &&
           matte.row(static_cast<int>(place.y))[static_cast<int>(place.x)] >= 128;
}

Status check_on_region(const FormGuide& stroke, const Matte& visible) {
    for (std::size_t k = 0; k < stroke.numbers.size(); k += 4) {
        int inside = 0;
        for (int i = 0; i < kAlong; ++i) {
            const double t = static_cast<double>(i) / (kAlong - 1);
            inside += shows(visible, (1 - t) * stroke.place(k) + t * stroke.place(k + 2)) ? 1 : 0;
        }
        if (inside == 0)
            return fail(ErrorCode::kUsage,
                        "A " + std::string(info_of(stroke.kind).name) +
                            " stroke lies outside of the region on its reference frame.",
                        "Draw it on the surface" + by({{setting::kFormStrokes}}) + ".");
    }
    return {};
}

Expected<DrawnSurface> surface_of(const RegionPlan& region, Size plate) {
    const DrawnCamera camera{plate, region.form_fov_deg};
    for (const FormGuide& guide : region.form_guides)
        if (is_shape(guide.kind)) return drawn_surface(guide, camera);
    return drawn_plane(region.form_guides, camera);
}

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

}  // namespace

Expected<FormMap> form_from_drawing(const FormEvidence& evidence, Size plate,
                                    const RegionPlan& region) {
    for (const FormGuide& guide : region.form_guides)
        if (guide.kind == FormGuideKind::kParallel)
            WEFT_CHECK_OK(check_on_region(guide, evidence.visible));
    auto surface = surface_of(region, plate);
    if (!surface) {
        Error error = std::move(surface).error();
        std::string& last = error.remedy.empty() ? error.message : error.remedy;
        last += by({{setting::kFormShape}, {setting::kFormStrokes}}) + ".";
        return tl::unexpected(std::move(error));
    }
    const Recti box = matte_box(evidence.visible);
    if (box.empty()) {
        return fail(
            ErrorCode::kUsage,
            "The region's matte is empty on its reference frame, so a shape has nothing to lie on.",
            "Choose another reference frame" + by({{setting::kReferenceFrame}}) + ".");
    }
    MetricField field = field_over(plate, domain_of(box, plate, surface->is_plane()));
    add_surface(field, *surface, evidence.visible);
    MetricField::Beyond beyond;
    if (surface->is_plane()) beyond = [&](Vec2 place) { return surface->metric(place); };
    if (!field.finish(beyond)) {
        return fail(ErrorCode::kUsage,
                    "The shape does not lie on the region on its reference frame.",
                    "Draw it over the surface" + by({{setting::kFormShape}}) + ".");
    }
    FormMap out = flat_from_reference(field);
    out.finding = {FormFinding::Source::kShape,
                   surface->is_plane(),
                   1,
                   1.0f,
                   static_cast<float>(surface->tilt_deg),
                   static_cast<float>(surface->tilt_error_deg),
                   static_cast<float>(surface->fov_deg)};
    add_relief(out, field, surface->fov_deg, plate, surface->is_plane());
    return out;
}

Status level_form(const FormEvidence& evidence, const RegionPlan& region, FormMap& form) {
    if (form.finding.source == FormFinding::Source::kNone) return {};
    bool any = false;
    for (const FormGuide& guide : region.form_guides) {
        if (guide.kind != FormGuideKind::kLevel) continue;
        WEFT_CHECK_OK(check_on_region(guide, evidence.visible));
        any = true;
    }
    if (!any) return {};
    const Recti box = matte_box(evidence.visible);
    turn_level(
        form, region.form_guides,
        0.5f * Vec2(static_cast<float>(box.x0 + box.x1), static_cast<float>(box.y0 + box.y1)));
    return {};
}

}  // namespace weft
