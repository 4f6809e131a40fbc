#include "app/motion_export/motion_plan.h"

#include <algorithm>
#include <set>

#include "app/shot/frame_plan.h"
#include "engine/core/setting.h"
#include "engine/pipeline/partial_plan.h"

namespace weft {
namespace {

bool is_meant(const Region& region, const std::string& name) {
    return region.name == name || std::to_string(region.id) == name;
}

std::string names_of(const Shot& shot) {
    std::string out;
    for (const std::size_t index : shot.region_index)
        out += (out.empty() ? "'" : ", '") + shot.project.regions[index]->name + "'";
    return out;
}

Expected<std::vector<MotionRegion>> chosen_regions(const MotionJobSpec& spec, const Shot& shot) {
    if (shot.plan.regions.empty())
        return fail(ErrorCode::kUsage, "The project has no region.",
                    "Add one with a matte" + by({{setting::kAddRegion}}) + ".");
    std::set<std::size_t> chosen;
    for (std::size_t k = 0; spec.regions.empty() && k < shot.region_index.size(); ++k)
        chosen.insert(k);
    for (const std::string& name : spec.regions) {
        const auto at = std::find_if(
            shot.region_index.begin(), shot.region_index.end(),
            [&](std::size_t index) { return is_meant(*shot.project.regions[index], name); });
        if (at == shot.region_index.end())
            return fail(ErrorCode::kUsage, "There is no enabled region '" + name + "'.",
                        "Choose among " + names_of(shot) + by({{setting::kRegion}}) + ".");
        chosen.insert(static_cast<std::size_t>(at - shot.region_index.begin()));
    }
    std::vector<MotionRegion> out;
    for (const std::size_t k : chosen) {
        const Region& region = *shot.project.regions[shot.region_index[k]];
        const RegionPlan& plan = shot.plan.regions[k];
        if (plan.temporal != TemporalMode::kLocked)
            return fail(ErrorCode::kUsage,
                        "The surface of region '" + region.name +
                            "' is followed in the locked temporal mode only.",
                        "Set the mode" + by({{setting::kTemporalMode, "locked"}}) +
                            ", or choose other regions.");
        out.push_back({static_cast<int>(k), region.name, plan.reference_frames.front()});
    }
    return out;
}

Status set_references(int reference, const std::vector<int>& shot,
                      std::vector<MotionRegion>& regions) {
    for (MotionRegion& region : regions) {
        if (region.reference == reference) continue;
        if (!std::binary_search(shot.begin(), shot.end(), reference))
            return fail(
                ErrorCode::kMissingFrames,
                "The reference frame " + std::to_string(reference) + " is not one of the shot.",
                "Choose among its " + frames_text(shot) + ".");
        region.reference = reference;
    }
    return {};
}

void add_all(std::set<int>& frames, const MotionPlan& motion) {
    for (const int frame : motion.frames) {
        frames.insert(frame);
        for (const int step : {-1, 1})
            if (const auto beside = motion.neighbour(frame, step)) frames.insert(*beside);
    }
    for (const MotionRegion& region : motion.regions)
        frames.insert(region.reference);
}

// Leaves only what the export needs to be analysed. The form says which plane corners are of and
// how deep a mesh is; all
// regions whose motion tells something of the lens decide it together.
void leave_rest_out(const MotionJobSpec& spec, MotionPlan& motion) {
    std::vector<RegionPlan>& regions = motion.plan.regions;
    std::vector<char> chosen(regions.size(), 0);
    bool lens = false;
    const bool forms = spec.what.corner_pins || spec.what.mesh;
    for (const MotionRegion& region : motion.regions) {
        const auto k = static_cast<std::size_t>(region.index);
        chosen[k] = 1;
        lens = lens || (forms && regions[k].shares_lens());
    }
    for (std::size_t k = 0; k < regions.size(); ++k) {
        RegionPlan& region = regions[k];
        const bool form = (chosen[k] && forms) || (lens && region.shares_lens());
        const auto zones = chosen[k] ? region.zones : std::vector<ZonePlan>();
        leave_look_out(region);
        region.zones = zones;  // they may change the motion
        if (!form) region.form_from = RegionPlan::FormFrom::kNothing;
        if (!chosen[k] && !form) leave_region_out(region);
    }
}

}  // namespace

std::optional<int> MotionPlan::neighbour(int frame, int step) const {
    const bool there = std::binary_search(shot_frames.begin(), shot_frames.end(), frame + step);
    return there ? std::optional(frame + step) : std::nullopt;
}

Expected<MotionPlan> plan_motion(const MotionJobSpec& spec, const Shot& shot) {
    MotionPlan out;
    WEFT_TRY(regions, chosen_regions(spec, shot));
    out.regions = std::move(regions);
    out.shot_frames = shot.plan.frames;
    WEFT_TRY(frames, frames_of_shot(spec.frames, out.shot_frames));
    out.frames = std::move(frames);
    if (spec.reference)
        WEFT_CHECK_OK(set_references(*spec.reference, out.shot_frames, out.regions));
    out.plan = shot.plan;
    std::set<int> followed;
    add_all(followed, out);
    out.plan.frames.assign(followed.begin(), followed.end());
    leave_rest_out(spec, out);
    return out;
}

bool shows_black(const Shot& shot, int frame) {
    return shot.project.plate.missing == MissingFrames::kBlack &&
           shot.plate->shown_frame(frame) != frame;
}

}  // namespace weft
