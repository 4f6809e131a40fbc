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

// Where the plate holds a frame in place of a missing one, so does whatever belongs to it.
Status check_pattern(const std::string& text, const char* what, const std::vector<int>& wanted,
                     const FrameReader& plate) {
    WEFT_TRY(pattern, SequencePattern::parse(text));
    if (pattern.is_single()) return {};
    WEFT_TRY(present, pattern.list_frames());
    std::vector<int> missing = missing_in(wanted, present);
    std::erase_if(missing, [&](int frame) {
        return plate.shown_frame(frame) != frame &&
               std::binary_search(present.begin(), present.end(), plate.shown_frame(frame));
    });
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

// Those of `frames` for which the pattern has a file; all of them for a still or no pattern.
Expected<std::vector<int>> with_files(const std::string& text, std::vector<int> frames) {
    if (text.empty()) return frames;
    WEFT_TRY(pattern, SequencePattern::parse(text));
    if (pattern.is_single()) return frames;
    WEFT_TRY(present, pattern.list_frames());
    std::vector<int> both;
    std::set_intersection(frames.begin(), frames.end(), present.begin(), present.end(),
                          std::back_inserter(both));
    return both;
}

// The run of frames around `reference`, at most `reach` to each side, for which all files are
// there.
Expected<FrameSpan> run_around(const Region& region, const FrameReader& plate, int reference,
                               int reach) {
    std::vector<int> frames = plate.frames();
    std::vector<std::string> patterns{region.matte->files, region.motion.files};
    for (const MatteSource& holdout : *region.holdouts)
        patterns.push_back(holdout.files);
    for (const std::string& pattern : patterns) {
        WEFT_TRY(left, with_files(pattern, std::move(frames)));
        frames = std::move(left);
    }
    const auto has = [&](int f) { return std::binary_search(frames.begin(), frames.end(), f); };
    FrameSpan run{reference, reference};
    while (run.first > reference - reach && has(run.first - 1))
        --run.first;
    while (run.last < reference + reach && has(run.last + 1))
        ++run.last;
    return run;
}

}  // namespace

Expected<std::vector<int>> grain_frames(const Region& region, const RegionPlan& plan,
                                        const FrameReader& plate) {
    if (!(plan.grain > 0)) return std::vector<int>{};
    constexpr int kReach = 3;
    const int reference = plan.reference_frames.front();
    WEFT_TRY(run, run_around(region, plate, reference, kReach));
    if (run.last == reference) return std::vector<int>{};
    return frames_between(reference, run.last);
}

Expected<std::vector<int>> shutter_frames(const Region& region, const RegionPlan& plan,
                                          const FrameReader& plate) {
    if (plan.shutter_deg == 0.0f || plan.temporal != TemporalMode::kLocked)
        return std::vector<int>{};
    constexpr int kMeasured = 6;
    const int reference = plan.reference_frames.front();
    WEFT_TRY(run, run_around(region, plate, reference, plan.shutter_deg ? 1 : kMeasured));
    if (run.last == reference) return std::vector<int>{};
    return frames_between(reference, run.last);
}

Expected<std::vector<int>> light_evidence(const Region& region, const RegionPlan& plan,
                                          const ShotPlan& shot, const FrameReader& plate) {
    if (!plan.estimates_light() || shot.quality == FlowQuality::kDraft) return std::vector<int>{};
    constexpr int kReach = 48, kMostFrames = 20;
    const int reference = plan.reference_frames.front();
    WEFT_TRY(run, run_around(region, plate, reference, kReach));
    const auto [first, last] = run;
    const int steps = std::min(last - first, kMostFrames - 1);
    std::vector<int> chosen{first};
    for (int k = 1; k <= steps; ++k)
        chosen.push_back(first + (last - first) * k / steps);
    return chosen;
}

std::string frames_text(const std::vector<int>& frames) {
    const std::string list = format_frame_list(frames);
    constexpr std::size_t kLongest = 80;
    const std::string shown =
        list.size() <= kLongest ? list : list.substr(0, list.rfind(',', kLongest)) + ",…";
    return (frames.size() == 1 ? "frame " : "frames ") + shown;
}

Expected<std::vector<int>> frames_to_render(const Project& project, const FrameReader& plate) {
    std::vector<int> frames = plate.frames();
    if (!project.settings.frames.empty()) {
        WEFT_TRY(list, parse_frame_list(project.settings.frames));
        frames = std::move(list);
    }
    if (project.plate.missing == MissingFrames::kSkip)
        std::erase_if(frames, [&](int frame) { return plate.shown_frame(frame) != frame; });
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
    if (!plan.propagated())
        WEFT_CHECK_OK(check_pattern(region.matte->files, "The matte", all, plate));
    for (const MatteSource& holdout : *region.holdouts) {
        if (!holdout.files.empty())
            WEFT_CHECK_OK(check_pattern(holdout.files, "The holdout", all, plate));
    }
    for (const std::string& pass : {region.light.albedo, region.light.lighting}) {
        if (!pass.empty()) WEFT_CHECK_OK(check_pattern(pass, "The lighting pass", all, plate));
    }
    if (plan.has_uv)
        WEFT_CHECK_OK(check_pattern(region.placement.uv, "The UV pass", shot.frames, plate));
    if (plan.has_depth)
        WEFT_CHECK_OK(check_pattern(region.finish.depth, "The depth pass", shot.frames, plate));
    if (plan.has_lines) {
        WEFT_CHECK_OK(check_pattern(region.lines.files, "The line pass", shot.frames, plate));
    }
    if (!plan.track.empty() && plan.temporal != TemporalMode::kNone) {
        std::vector<int> tracked;
        for (const auto& [frame, corners] : plan.track)
            tracked.push_back(frame);
        const std::vector<int> untracked = missing_in(all, tracked);
        if (!untracked.empty()) {
            return fail(ErrorCode::kMissingFrames,
                        "The track " + region.motion.track + " has nothing for " +
                            frames_text(untracked) +
                            ". Track the whole shot, or render only the frames that it has "
                            "(--frames).");
        }
    }
    if (plan.true_motion && plan.temporal != TemporalMode::kNone) {
        WEFT_CHECK_OK(
            check_pattern(region.motion.files, "The motion", motion_frames(plan, span), plate));
    }
    return {};
}

}  // namespace weft
