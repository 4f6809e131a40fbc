#include "app/flatten/flat_plan.h"

#include <algorithm>
#include <set>

#include "app/shot/frame_plan.h"
#include "engine/core/setting.h"
#include "engine/pipeline/partial_plan.h"

namespace weft {
namespace {

constexpr std::size_t kMostFlatFrames = 32;

Expected<std::size_t> chosen_region(const FlattenSpec& spec) {
    const auto& regions = spec.project.regions;
    if (!spec.region.empty()) {
        WEFT_TRY(index, find_region(spec.project, spec.region));
        if (regions[index]->enabled) return index;
        return fail(ErrorCode::kUsage, "Region '" + regions[index]->name + "' is not enabled.",
                    "Enable it" + by({{"enabled"}}) + ".");
    }
    std::vector<std::size_t> enabled;
    for (std::size_t k = 0; k < regions.size(); ++k)
        if (regions[k]->enabled) enabled.push_back(k);
    if (enabled.size() == 1) return enabled.front();
    if (enabled.empty())
        return fail(ErrorCode::kUsage, "The project has no enabled region.",
                    "Add one with a matte" + by({{setting::kAddRegion}}) + ".");
    return fail(ErrorCode::kUsage,
                "The project has " + std::to_string(enabled.size()) +
                    " regions, and one picture holds one.",
                "Choose one" + by({{setting::kRegion}}) + ".");
}

// Evenly spread, both ends included.
std::vector<int> spread_frames(const std::vector<int>& frames) {
    if (frames.size() <= kMostFlatFrames) return frames;
    std::vector<int> out;
    for (std::size_t k = 0; k < kMostFlatFrames; ++k)
        out.push_back(frames[k * (frames.size() - 1) / (kMostFlatFrames - 1)]);
    return out;
}

// The plate's light in full and relative to the reference frame, and nothing else of the look.
void keep_light_only(RegionPlan& region) {
    region.light.form = LightForm::kGain;
    region.light.strength = 1;
    region.strength_keys = {};
    region.detail = kEstimatedDetail;
    region.keep_detail = 0;
    region.cast = 0.0f;
    region.highlights = 0;
    region.exact_light = false;
    std::erase_if(region.zones, [](const ZonePlan& zone) { return !changes_motion(zone.kind); });
    region.gloss_evidence.clear();
    leave_camera_out(region);
}

}  // namespace

bool all_have_textures(const Project& project) {
    return std::all_of(project.regions.begin(), project.regions.end(), [](const auto& region) {
        return !region->enabled || !region->texture.sample.empty() ||
               !region->texture.plane.empty();
    });
}

Expected<Project> flat_project(const FlattenSpec& spec) {
    WEFT_TRY(chosen, chosen_region(spec));
    Project out = spec.project;
    out.regions[chosen] = out.regions[chosen].with([](Region& region) {
        // Light that is not estimated is not in the analysis either.
        LightParams& light = region.light;
        const bool estimated = light.source == LightSource::kPlate && !is_transfer(light.form) &&
                               (light.strength > 0 || !light.strength_keys.empty());
        if (estimated) return;
        light.source = LightSource::kPlate;
        light.form = LightForm::kGain;
        light.strength = 1;
        light.strength_keys = {};
    });
    return out;
}

Expected<FlatPlan> plan_flat(const FlattenSpec& spec, const Shot& shot) {
    WEFT_TRY(chosen, chosen_region(spec));
    FlatPlan out;
    const auto at = std::find(shot.region_index.begin(), shot.region_index.end(), chosen);
    out.region = static_cast<int>(at - shot.region_index.begin());
    out.plan = shot.plan;
    RegionPlan& region = out.plan.regions[static_cast<std::size_t>(out.region)];
    if (region.temporal != TemporalMode::kLocked)
        return fail(ErrorCode::kUsage,
                    "The surface of region '" + shot.project.regions[chosen]->name +
                        "' is followed in the locked temporal mode only.",
                    "Set the mode" + by({{setting::kTemporalMode, "locked"}}) + ".");
    out.has_texture = region.texture != nullptr;
    WEFT_TRY(frames, frames_of_shot(spec.frames, shot.plan.frames));
    out.frames = spec.frames.empty() ? spread_frames(frames) : std::move(frames);
    std::set<int> followed(out.frames.begin(), out.frames.end());
    followed.insert(region.reference_frames.front());
    followed.insert(region.light_reference());
    out.plan.frames.assign(followed.begin(), followed.end());
    const bool lens = region.shares_lens() && out.has_texture;
    keep_light_only(region);
    // The form only says how the texture lies.
    if (!out.has_texture) region.form_from = RegionPlan::FormFrom::kNothing;
    for (std::size_t k = 0; k < out.plan.regions.size(); ++k) {
        if (static_cast<int>(k) == out.region) continue;
        RegionPlan& other = out.plan.regions[k];
        const bool needed = lens && other.shares_lens();
        leave_look_out(other);
        if (needed) continue;
        other.form_from = RegionPlan::FormFrom::kNothing;
        leave_region_out(other);
    }
    return out;
}

}  // namespace weft
