#include "app/shot/region_reference.h"

#include <algorithm>

#include "app/shot/frame_plan.h"
#include "app/shot/lit_frame.h"
#include "engine/core/setting.h"

namespace weft {
namespace {

// The frames that can be reached from the reference frame and show the surface.
Expected<std::vector<int>> reachable(const Region& region, const CachedReader& plate,
                                     const MatteLooks& looks, int reference,
                                     const std::vector<int>& leave_out) {
    const int all = plate.frames().back() - plate.frames().front() + 1;
    WEFT_TRY(run, run_around(region, plate, reference, all, leave_out));
    std::vector<int> out = plate.frames();
    std::erase_if(out, [&](int frame) {
        return frame < run.first || frame > run.last ||
               (frame != reference && shows_nothing(region, plate, frame, looks));
    });
    return out;
}

std::string note_of(const std::string& region, int chosen, int first, const char* why) {
    return "Region '" + region + "': the reference frame is " + std::to_string(chosen) +
           ", because " + why + " frame " + std::to_string(first) + ". Set another if needed" +
           by({{setting::kReferenceFrame}}) + ".";
}

}  // namespace

Expected<ShotReference> add_reference(const Region& region, const CachedReader& plate,
                                      const MatteLooks& looks, const std::vector<int>& leave_out,
                                      RegionPlan& plan, std::vector<std::string>& notes) {
    WEFT_CHECK_OK(check_named_frames(region, plate));
    plan.reference_frames = region.reference_frames;
    const bool by_default = plan.reference_frames.empty();
    if (by_default) {
        WEFT_TRY(chosen, choose_reference(region, plate, looks));
        plan.reference_frames = {chosen.frame};
        if (chosen.frame != chosen.first)
            notes.push_back(note_of(region.name, chosen.frame, chosen.first,
                                    "the surface is hardly visible on"));
    }
    const int reference = plan.reference_frames.front();
    const auto light = light_of_frame(plate, reference, looks.memory);
    if (!light || !is_doubtful(*light)) return ShotReference{reference, by_default, false, {}};
    WEFT_TRY(candidates, reachable(region, plate, looks, reference, leave_out));
    const auto lit = lit_frame(plate, reference, candidates, looks.memory);
    if (!lit) return ShotReference{reference, by_default, false, {}};
    if (by_default && !region.matte->files.empty()) {
        plan.reference_frames = {*lit};
        notes.push_back(note_of(region.name, *lit, reference, "the plate is dark or burnt out on"));
        return ShotReference{*lit, true, false, {}};
    }
    plan.light_frame = *lit;
    notes.push_back("Region '" + region.name + "': its light is relative to frame " +
                    std::to_string(*lit) +
                    ", because the plate is dark or burnt out on the reference frame " +
                    std::to_string(reference) + ".");
    return ShotReference{reference, by_default, false, {}};
}

}  // namespace weft
