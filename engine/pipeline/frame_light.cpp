#include "engine/pipeline/frame_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/lighting/exact_light.h"
#include "engine/lighting/plate_detail.h"
#include "engine/lighting/plate_tint.h"
#include "engine/lighting/plate_transfer.h"
#include "engine/pipeline/region_light.h"
#include "engine/pipeline/region_zones.h"

namespace weft {
namespace {

// S ← S₀ (S / S₀)^λ: more contrast than the light has.
void raise_light(Shading& shading, float reference, float strength) {
    if (!(reference > 0)) return;
    for (std::size_t i = 0; i < shading.value.size_bytes() / sizeof(float); ++i) {
        float& s = shading.value.data()[i];
        if (s > 0) s = reference * std::pow(s / reference, strength);
    }
}

// Light within this factor of the frame's own is never limited.
constexpr float kAroundLevel = 2.0f;
// Of the reference frame's light: a surface with less is not in shade but about to vanish.
constexpr float kVanishing = 0.1f;
constexpr int kSampledColumns = 320;
constexpr float kDarkest = 1e-6f;  // a shading is above 0

}  // namespace

Expected<FrameLight> FrameLight::find(const FrameLightInputs& inputs) {
    FrameLight out(inputs);
    const RegionPlan& region = out.region();
    out.options_ = region.light;
    out.options_.strength = region.strength_at(inputs.frame);
    if (!region.lights() || is_transfer(region.light.form)) return out;
    out.shading_ = inputs.scene.picture_light;
    if (!out.shading_) {
        auto found = region_shading(inputs.source, region, inputs.store, inputs.index, inputs.frame,
                                    inputs.working);
        if (!found) return tl::unexpected(std::move(found.error()));
        if (*found) out.shading_.emplace(std::move(**found));
    }
    if (out.shading_) WEFT_CHECK_OK(out.change());
    return out;
}

Matte FrameLight::on_surface(ViewU8x1 inside) const {
    Matte out(inside.size());
    for (int y = 0; y < inside.height(); ++y) {
        const std::uint8_t* old = in_.matte.pixel(in_.box.x0, in_.box.y0 + y);
        std::transform(inside.row(y), inside.row(y) + inside.width(), old, out.row(y),
                       [](std::uint8_t a, std::uint8_t b) { return std::min(a, b); });
    }
    return out;
}

Status FrameLight::change() {
    const RegionPlan& plan = region();
    if (plan.light_source == LightSource::kPlate) {
        WEFT_TRY(detail, light_detail(in_.source, in_.plan, in_.store, in_.index, in_.frame));
        if (!detail.empty())
            shading_ = with_light_detail(*shading_, in_.working, in_.matte, in_.box, detail);
    }
    if (!plan.zones.empty()) {
        WEFT_TRY(factor, zone_factor(in_.source, in_.plan, in_.store, in_.index, ZoneKind::kLight,
                                     in_.frame));
        scale_light(*shading_, in_.scene.reference_shading, factor);
    }
    if (options_.strength > 1) {
        raise_light(*shading_, in_.scene.reference_shading, options_.strength);
        options_.strength = 1;
    }
    if (plan.light_source == LightSource::kPlate && options_.form == LightForm::kGain) {
        if (in_.plan.display_referred && plan.estimates_light()) WEFT_CHECK_OK(find_white());
        follow_fade();
    }
    return {};
}

// White that the picture is mixed with is no light on the surface, and lies over the new one, too.
Status FrameLight::find_white() {
    WEFT_TRY(plate, in_.source.plate(in_.frame));
    const int step = std::max(1, plate->width() / kSampledColumns);
    ImageF3 few(plate->width() / step, plate->height() / step);
    for (int y = 0; y < few.height(); ++y)
        for (int x = 0; x < few.width(); ++x)
            std::copy_n(plate->pixel(x * step, y * step), 3, few.pixel(x, y));
    in_.plan.working_from_plate->apply(few);
    const LightRange surface =
        light_range(in_.working.view().crop(in_.box), in_.matte.view().crop(in_.box));
    white_ = white_share(in_.scene.reference_range, {light_range(few, {}), surface});
    if (!(white_ > 0)) return {};
    const float own = surface.middle > white_ ? 1 - white_ / surface.middle : 0.0f;
    for (std::size_t i = 0; i < shading_->value.size_bytes() / sizeof(float); ++i)
        shading_->value.data()[i] = std::max(kDarkest, own * shading_->value.data()[i]);
    return {};
}

// Fades, dissolves and flashes change the light of the whole surface far beyond the limits of the
// gain, which are there for errors of its parts. In a picture that is almost black, the share of
// the texture that takes no light goes with it.
void FrameLight::follow_fade() {
    const float reference = in_.scene.reference_shading;
    const float level = median_shading(*shading_, in_.matte) / reference;
    if (!(reference > 0) || !std::isfinite(level)) return;
    options_.least_gain = std::min(options_.least_gain, level / kAroundLevel);
    options_.most_gain = std::max(options_.most_gain, level * kAroundLevel);
    const float left = level / kVanishing;
    if (left >= 1 || options_.strength >= 1) return;
    const float unlit = (1 - options_.strength) * left * reference;
    for (std::size_t i = 0; i < shading_->value.size_bytes() / sizeof(float); ++i) {
        float& s = shading_->value.data()[i];
        s = options_.strength * s + unlit;
    }
    options_.strength = 1;
}

void FrameLight::tint(ViewU8x1 inside, ImageF3& texture) const {
    const RegionPlan& plan = region();
    const RegionScene& scene = in_.scene;
    if (!plan.tints()) return;
    apply_tint(texture, inside, scene.tint, plan.cast.value_or(1.0f));
    // Of its own accord the texture takes the colours that the whole shot's sun and sky show; what
    // one region's colours follow may be its paint.
    const LightColour here =
        plan.cast ? light_colour(in_.working, in_.matte, *shading_) : scene.reference_colour;
    apply_cast(texture, {in_.box.x0, in_.box.y0}, inside, *shading_, scene.reference_shading, here,
               scene.reference_colour, plan.cast.value_or(1.0f));
}

Status FrameLight::put_light(ViewU8x1 inside, ImageF3& texture) const {
    const RegionPlan& plan = region();
    if (!plan.lights()) return {};
    const Vec2i origin(in_.box.x0, in_.box.y0);
    const ViewF3 old_surface = in_.working.view().crop(in_.box);
    if (is_transfer(options_.form)) {
        const float share = std::min(1.0f, options_.strength);
        if (options_.form == LightForm::kStatistics)
            transfer_statistics(texture, old_surface, inside, share);
        else
            match_histogram(texture, old_surface, inside, share);
        return {};
    }
    if (plan.exact_light && plan.light_pass != RegionPlan::Pass::kNone) {
        WEFT_TRY(pass, in_.source.light_pass(in_.index, in_.frame));
        const ViewF3 part = pass.view().crop(in_.box);
        const bool albedo = plan.light_pass == RegionPlan::Pass::kAlbedo;
        apply_exact_light(texture, old_surface, albedo ? part : ViewF3(), albedo ? ViewF3() : part,
                          inside, options_.strength);
        return {};
    }
    if (!shading_) return {};
    apply_light(texture, origin, inside, *shading_, in_.scene.reference_shading, options_);
    if (in_.scene.picture_light) return {};
    tint(inside, texture);
    return {};
}

// What moves over the surface; empty where colours decide, or its motion tells nothing.
Expected<MovingGloss> FrameLight::moving_gloss_here(ViewU8x1 inside) const {
    const StillSurface& still = in_.scene.still;
    MovingGloss out;
    if (!(still.confidence > 0) || in_.scene.colours.confidence >= 1) return out;
    WEFT_TRY(bytes, in_.store.get({in_.index, in_.frame, AnalysisKind::kCoords}));
    WEFT_TRY(ref_from_cur, decode_lattice(bytes));
    out.luminance = moving_gloss({in_.box.x0, in_.box.y0}, in_.working.view().crop(in_.box), inside,
                                 still, ref_from_cur);
    out.confidence = still.confidence;
    return out;
}

Expected<ImageF3> FrameLight::put_gloss(ViewU8x1 inside, ImageF3& texture) const {
    const RegionPlan& plan = region();
    const bool from_estimate =
        plan.lights() && !is_transfer(plan.light.form) && !in_.scene.picture_light;
    const bool exact = plan.exact_light && plan.light_pass != RegionPlan::Pass::kNone;
    if (!from_estimate || exact || !shading_ || !(plan.highlights > 0)) return ImageF3();
    WEFT_TRY(moving, moving_gloss_here(inside));
    Highlights found =
        find_highlights({in_.box.x0, in_.box.y0}, in_.working.view().crop(in_.box), inside,
                        *shading_, in_.scene.colours, moving,
                        {plan.highlights, plan.highlight_roughness, in_.working.width()});
    add_highlights(texture, found);
    return std::move(found.gloss);
}

Expected<ImageF3> FrameLight::apply(ViewU8x1 inside, ImageF3& texture) const {
    WEFT_CHECK_OK(put_light(inside, texture));
    if (white_ > 0) {
        std::for_each(texture.data(), texture.data() + texture.size_bytes() / sizeof(float),
                      [this](float& v) { v += white_; });
        return ImageF3();
    }
    const Matte seen = on_surface(inside);
    WEFT_TRY(gloss, put_gloss(seen, texture));
    const auto keep_detail = [&](ImageF3& picture) {
        keep_plate_detail(picture, {in_.box.x0, in_.box.y0}, in_.working, seen,
                          shading_ ? &*shading_ : nullptr, region().keep_detail);
    };
    keep_detail(texture);
    if (!gloss.empty()) keep_detail(gloss);
    return gloss;
}

}  // namespace weft
