#include "engine/pipeline/region_scene.h"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/lighting/daylight.h"
#include "engine/lighting/plate_exposure.h"
#include "engine/lighting/plate_tint.h"
#include "engine/pipeline/frame_focus.h"
#include "engine/pipeline/frame_layers.h"
#include "engine/pipeline/gloss_pass.h"
#include "engine/pipeline/plate_alpha.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_form.h"
#include "engine/pipeline/region_light.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/synthesis_inputs.h"
#include "engine/pipeline/track_seams.h"

namespace weft {
namespace {

constexpr int kSmallestPlane = 512, kLargestPlane = 4096;

int plane_side(int plate_px, float scale) {
    const float texels = 1.25f * static_cast<float>(plate_px) / scale;
    const int rounded = static_cast<int>(std::ceil(std::min(texels, 1e6f) / 64.0f)) * 64;
    return std::clamp(rounded, kSmallestPlane, kLargestPlane);
}

// Grown, or found where it was grown before.
Expected<TexturePlane> kept_texture(const ShotPlan& plan, const RegionPlan& region,
                                    const PlaneOptions& options, const CancelToken& cancel,
                                    const ProgressFn& progress) {
    if (!plan.stages) return grow_texture(region, options, cancel, progress);
    const Hash128 key = plane_key(synthesis_samples(region), options);
    if (auto before = plan.stages->plane(key)) return std::move(*before);
    WEFT_TRY(plane, grow_texture(region, options, cancel, progress));
    plan.stages->keep_plane(key, plane);
    return plane;
}

struct ReferenceView {
    ImageF3 working;  // the plate
    Matte visible;
};

// S₀, the plate's median shading inside the matte on the reference frame, and the light's colour
// there. Painted light is relative to 1. Returns the shading.
Expected<Shading> take_plate_light(const ShotSource& source, const ShotPlan& plan,
                                   const AnalysisStore& store, int index, int frame,
                                   const ReferenceView& view, RegionScene& scene) {
    const RegionPlan& region = plan.regions[static_cast<std::size_t>(index)];
    WEFT_TRY(shading, region_shading(source, region, store, index, frame, view.working));
    scene.reference_shading = median_shading(*shading, view.visible);
    scene.reference_range = {light_range(view.working, {}),
                             light_range(view.working, view.visible)};
    if (region.tints()) {
        scene.reference_colour = region.cast ? light_colour(view.working, view.visible, *shading)
                                             : daylight_colour(find_daylight(view.working));
        scene.tint = region.cast ? plate_tint(view.working) : likely_tint(view.working);
    }
    if (region.highlights > 0) {
        scene.colours = surface_colours(view.working, view.visible, likely_tint(view.working));
        WEFT_TRY(still, still_surface(plan, store, index));
        scene.still = std::move(still);
    }
    return std::move(*shading);
}

Status take_reference_light(const ShotSource& source, const ShotPlan& plan,
                            const AnalysisStore& store, int index, int frame, RegionScene& scene) {
    const RegionPlan& region = plan.regions[static_cast<std::size_t>(index)];
    const bool from_plate =
        region.light_source == LightSource::kPlate &&
        (region.estimates_light() || region.light_pass != RegionPlan::Pass::kNone);
    // A light that is used unchanged has the plate's exposure in it.
    const bool matches = region.match > 0 && !region.exact_light;
    if (!from_plate && !matches) return {};
    WEFT_TRY(plate, source.plate(frame));
    WEFT_TRY(working, working_plate(source, plan, frame, *plate));
    WEFT_TRY(extent, extent_matte(source, plan, store, index, frame));
    WEFT_TRY(holdout, holdout_matte(source, plan, store, index, frame));
    const ReferenceView view{std::move(working), without_holdout(extent, holdout)};
    std::optional<Shading> shading;
    if (from_plate) {
        WEFT_TRY(found, take_plate_light(source, plan, store, index, frame, view, scene));
        shading = std::move(found);
    }
    if (matches) {
        scene.exposure = plate_exposure(view.working, view.visible, shading ? &*shading : nullptr,
                                        scene.reference_shading, plan.exposure_greys);
    }
    return {};
}

}  // namespace

float fullest_white(const RegionPlan& region, const RegionScene& scene) {
    const PlateExposure& found = scene.exposure;
    return std::pow(found.white, region.match) * (found.fullest / found.white);
}

Grade grade_on(const RegionPlan& region, const RegionScene& scene) {
    Grade grade = region.grade;
    const float matched = std::pow(scene.exposure.white, region.match);
    for (float& channel : grade.multiply)
        channel *= matched;
    return grade;
}

bool has_plane(const RegionPlan& region) {
    return region.temporal == TemporalMode::kLocked || region.texture->is_plane;
}

Expected<RegionPlane> make_plane(const ShotPlan& plan, const RegionPlan& region, Size plate,
                                 const CancelToken& cancel, const ProgressFn& progress,
                                 const Backend* backend) {
    const TexturePicture& texture = *region.texture;
    if (texture.is_plane) {
        return RegionPlane{PlanePyramid(transformed(texture.pixels, *region.working_from_texture),
                                        texture.wrap, finer_levels(texture.pixels.size())),
                           std::nullopt,
                           {},
                           nullptr};
    }
    PlaneOptions options =
        plane_options(region, plan.seed, plane_size(region.placement, plate), backend);
    options.tileable = options.whole_periods = true;
    options.amendments = region.amendments;
    WEFT_TRY(plane, kept_texture(plan, region, options, cancel, progress));
    RegionPlane out{PlanePyramid(plane_in_working_space(region, plane), WrapMode::kRepeat,
                                 finer_levels(plane.pixels.size())),
                    plane.stats, plan.layers ? seam_texels(plane) : Matte(), nullptr};
    if (plan.keep_planes) out.grown = std::make_shared<const TexturePlane>(std::move(plane));
    return out;
}

Expected<TextureMapping> mapping_on(const RegionPlan& region, const RegionScene& scene, int frame) {
    TextureMapping out = scene.mapping;
    if (region.placement_moves()) {
        WEFT_TRY(mapping, texture_mapping(region.placement_at(frame)));
        out = mapping.on_surface_of(scene.mapping);
    }
    if (region.form_amount_keys.empty()) return out;
    return out.with_form(form_on(region, out.form(), frame));
}

Size plane_size(const PlanePlacement& placement, Size plate) {
    const Size shown = placement.aspect.unsqueezed(plate);
    return {plane_side(shown.width, placement.scale), plane_side(shown.height, placement.scale)};
}

int finer_levels(Size plane) {
    constexpr std::int64_t kMostTexels = 8'000'000;
    const std::int64_t texels = std::int64_t{plane.width} * plane.height;
    return 16 * texels <= kMostTexels ? 2 : 4 * texels <= kMostTexels ? 1 : 0;
}

ImageF3 plane_in_working_space(const RegionPlan& region, const TexturePlane& plane) {
    std::vector<ImageF3> samples;
    samples.push_back(transformed(region.texture->pixels, *region.working_from_texture));
    for (const ImageF3& further : region.texture->also)
        samples.push_back(transformed(further, *region.working_from_texture));
    const std::vector<ImageU8x3> samples8 = synthesis_samples(region);
    ImageF3 out(plane.pixels.size());
    parallel_rows(out.height(), 32, [&](int y0, int y1) {
        ImageF3 before(out.width(), 1), after(out.width(), 1);
        for (int y = y0; y < y1; ++y) {
            bool feathered = false;
            for (int x = 0; x < out.width(); ++x) {
                const std::int32_t* from = plane.source.pixel(x, y);
                const std::size_t which = plane.origin.empty() ? 0 : plane.origin.pixel(x, y)[0];
                const ImageF3& sample = samples[which];
                const ImageU8x3& sample8 = samples8[which];
                for (int c = 0; c < 3; ++c) {
                    const std::uint8_t was = sample8.pixel(from[0], from[1])[c];
                    const std::uint8_t is = plane.pixels.pixel(x, y)[c];
                    out.pixel(x, y)[c] = sample.pixel(from[0], from[1])[c];
                    before.pixel(x, 0)[c] = static_cast<float>(was) / 255.0f;
                    after.pixel(x, 0)[c] = static_cast<float>(is) / 255.0f;
                    feathered |= was != is;
                }
            }
            if (!feathered) continue;
            region.working_from_display->apply(before);
            region.working_from_display->apply(after);
            for (int k = 0; k < 3 * out.width(); ++k) {
                out.row(y)[k] = std::max(0.0f, out.row(y)[k] + after.data()[k] - before.data()[k]);
            }
        }
    });
    return out;
}

Expected<RegionScene> make_scene(const ShotSource& source, const ShotPlan& plan,
                                 const AnalysisStore& store, int region_index,
                                 const CancelToken& cancel, const ProgressFn& progress,
                                 const Backend* backend, std::optional<RegionPlane> made) {
    const RegionPlan& region = plan.regions[static_cast<std::size_t>(region_index)];
    RegionScene scene;
    WEFT_TRY(mapping, texture_mapping(region.placement));
    WEFT_TRY(found, found_form(region, store, region_index));
    scene.form = std::move(found);
    WEFT_TRY(form, region_form(region, store, region_index));
    scene.mapping = mapping.with_form(form);
    if (has_plane(region)) {
        if (!made) {
            WEFT_TRY(plane, make_plane(plan, region, source.size(), cancel, progress, backend));
            made = std::move(plane);
        }
        scene.plane = std::move(made->pyramid);
        scene.stats = made->stats;
        scene.plane_seams = std::move(made->seams);
        scene.grown = std::move(made->grown);
        WEFT_TRY(seams, make_track_seams(source, plan, store, region_index, scene.plane,
                                         scene.mapping.form()));
        scene.seams = std::move(seams);
    }
    const int reference = region.reference_frames.front();
    if (region.grain > 0 && !region.grain_frames.empty()) {
        WEFT_TRY(bytes, store.get({region_index, reference, AnalysisKind::kGrain}));
        WEFT_TRY(grain, decode_grain(bytes));
        scene.grain = grain;
    }
    scene.shutter_deg = region.shutter_deg.value_or(0.0f);
    if (region.estimates_shutter()) {
        WEFT_TRY(bytes, store.get({region_index, reference, AnalysisKind::kShutter}));
        WEFT_TRY(degrees, decode_number(bytes));
        scene.shutter_deg = degrees;
    }
    const int lit = region.light_reference();
    WEFT_CHECK_OK(take_reference_light(source, plan, store, region_index, lit, scene));
    if (is_focus_followed(region)) {
        WEFT_TRY(extent, extent_matte(source, plan, store, region_index, reference));
        take_texture_focus(plan, region, extent, scene);
    }
    if (region.light_source == LightSource::kImage) {
        WEFT_TRY(extent, extent_matte(source, plan, store, region_index, reference));
        scene.picture_light =
            shading_from_image(*region.light_picture, matte_bounds(extent), source.size());
        scene.reference_shading = median_shading(*scene.picture_light, extent);
    }
    return scene;
}

}  // namespace weft
