#include "app/session/frame_plan.h"

#include <algorithm>

#include "engine/core/frame_range.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

std::vector<int> missing_in(const std::vector<int>& wanted, const std::vector<int>& present) {
    std::vector<int> missing;
    std::set_difference(wanted.begin(), wanted.end(), present.begin(), present.end(),
                        std::back_inserter(missing));
    return missing;
}

std::vector<int> frames_between(int first, int last) {
    std::vector<int> out;
    for (int f = first; f <= last; ++f)
        out.push_back(f);
    return out;
}

Status check_pattern(const std::string& text, const char* what, const std::vector<int>& wanted) {
    WEFT_TRY(pattern, SequencePattern::parse(text));
    if (pattern.is_single()) return {};
    WEFT_TRY(present, pattern.list_frames());
    const std::vector<int> missing = missing_in(wanted, present);
    if (missing.empty()) return {};
    return fail(ErrorCode::kMissingFrames,
                std::string(what) + " " + text + " has no file for " + frames_text(missing) +
                    ". Add the files, or render only the frames that have one (--frames).");
}

// The frames whose motion file is read: all of the span but the one that the motion would leave it
// at.
std::vector<int> motion_frames(const RegionPlan& plan, const FrameSpan& span) {
    return plan.motion_forward ? frames_between(span.first, span.last - 1)
                               : frames_between(span.first + 1, span.last);
}

}  // namespace

std::string frames_text(const std::vector<int>& frames) {
    const std::string list = format_frame_list(frames);
    constexpr std::size_t kLongest = 80;
    const std::string shown =
        list.size() <= kLongest ? list : list.substr(0, list.rfind(',', kLongest)) + ",…";
    return (frames.size() == 1 ? "frame " : "frames ") + shown;
}

Expected<std::vector<int>> frames_to_render(const Project& project, const FrameReader& plate) {
    if (project.settings.frames.empty()) return plate.frames();
    WEFT_TRY(frames, parse_frame_list(project.settings.frames));
    const std::vector<int> missing = missing_in(frames, plate.frames());
    if (!missing.empty()) {
        return fail(ErrorCode::kMissingFrames, "The plate " + project.plate.path + " has no " +
                                                   frames_text(missing) + ". It has " +
                                                   frames_text(plate.frames()) + ".");
    }
    return frames;
}

Status check_files(const Region& region, const RegionPlan& plan, const ShotPlan& shot,
                   const FrameReader& plate) {
    const FrameSpan span = analysed_span(shot, plan);
    const std::vector<int> all = frames_between(span.first, span.last);
    const std::vector<int> missing = missing_in(all, plate.frames());
    if (!missing.empty()) {
        return fail(ErrorCode::kMissingFrames,
                    "The plate has no " + frames_text(missing) +
                        ", which the surface has to be followed through. Restore the files, or "
                        "choose --frames and --reference-frame on one side of the gap.");
    }
    if (!plan.propagated()) WEFT_CHECK_OK(check_pattern(region.matte->files, "The matte", all));
    for (const MatteSource& holdout : *region.holdouts) {
        WEFT_CHECK_OK(check_pattern(holdout.files, "The holdout", all));
    }
    if (plan.has_lines) {
        WEFT_CHECK_OK(check_pattern(region.lines.files, "The line pass", shot.frames));
    }
    if (plan.true_motion && plan.temporal != TemporalMode::kNone) {
        WEFT_CHECK_OK(check_pattern(region.motion.files, "The motion", motion_frames(plan, span)));
    }
    return {};
}

}  // namespace weft
