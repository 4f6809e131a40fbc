// The frames that a region's settings name must be frames of the plate.
#include <algorithm>

#include "app/shot/frame_plan.h"
#include "engine/core/frame_range.h"
#include "engine/core/setting.h"

namespace weft {

Status check_named_frames(const Region& region, const FrameReader& plate) {
    const auto check = [&](int frame, const char* before, const std::string& after) -> Status {
        const std::vector<int>& frames = plate.frames();
        if (std::binary_search(frames.begin(), frames.end(), frame)) return {};
        return fail(
            ErrorCode::kMissingFrames,
            before + std::to_string(frame) + " is not in the plate (" + frames_list(frames) + ").",
            after);
    };
    for (const int frame : region.reference_frames)
        WEFT_CHECK_OK(check(frame, "The reference frame ",
                            "Give a frame of the plate" + by({{setting::kReferenceFrame}}) + "."));
    for (const auto& [frame, pins] : region.corrections)
        WEFT_CHECK_OK(check(frame, "The corrected frame ", "Remove the correction."));
    for (const auto& [frame, key] : region.matte->keyframes)
        WEFT_CHECK_OK(check(
            frame, "The painted matte's frame ",
            "Give the matte the number of a frame of the plate" + by({{setting::kMatte}}) + "."));
    const auto check_confirmed = [&](const MatteSource& matte) -> Status {
        for (const auto& [frame, edge] : matte.confirmed)
            WEFT_CHECK_OK(check(frame, "The frame of a confirmed part of a matte ",
                                "Confirm parts on frames of the plate only."));
        return {};
    };
    WEFT_CHECK_OK(check_confirmed(*region.matte));
    for (const MatteSource& holdout : *region.holdouts) {
        WEFT_CHECK_OK(check_confirmed(holdout));
        for (const auto& [frame, key] : holdout.keyframes)
            WEFT_CHECK_OK(check(
                frame, "The painted holdout's frame ",
                "Give it the number of a frame of the plate" + by({{setting::kHoldout}}) + "."));
    }
    for (const Zone& zone : *region.zones) {
        WEFT_CHECK_OK(check_confirmed(zone.matte));
        for (const auto& [frame, key] : zone.matte.keyframes)
            WEFT_CHECK_OK(
                check(frame, "The painted zone's frame ",
                      "Give it the number of a frame of the plate" + by({{setting::kZone}}) + "."));
    }
    return {};
}

}  // namespace weft
