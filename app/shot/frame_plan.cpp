#include "app/shot/frame_plan.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "app/shot/drawn_mattes.h"
#include "app/shot/form_files.h"
#include "app/shot/frame_gaps.h"
#include "app/shot/matte_movies.h"
#include "app/shot/reference_choice.h"
#include "engine/core/frame_range.h"
#include "engine/core/setting.h"
#include "engine/pipeline/focus_frames.h"
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

// Advice if the surface cannot be tracked from the reference to all frames. `usable`: the frames
// with all files.
std::string around_gap(const Region& region, const RegionPlan& plan, const ShotPlan& shot,
                       const FrameReader& plate, const std::vector<int>& usable) {
    const FrameSpan run = run_with(usable, shot.frames.front());
    if (run.last >= shot.frames.back()) {
        const auto inside = choose_reference(region, plate, nullptr, {run.first, run.last});
        if (inside && inside->frame >= run.first && inside->frame <= run.last) {
            return "Add the files, or use a reference frame on the same side of the gap" +
                   by({{setting::kReferenceFrame, std::to_string(inside->frame)}}) + ".";
        }
        return "Add the files.";
    }
    const FrameSpan side = run_with(usable, plan.reference_frames.front());
    std::vector<int> reached = shot.frames;
    std::erase_if(reached, [&](int f) { return f < side.first || f > side.last; });
    if (reached.empty())
        return "Add the files, or use another reference frame" + by({{setting::kReferenceFrame}}) +
               ".";
    return "Add the files, or render only " + frames_text(reached) + " on this side of the gap" +
           by({{setting::kFrames}}) + ".";
}

// A movie is one file, whatever it lacks.
const char* lacks(const MatteFiles& files) {
    return files.is_movie() ? " has no picture for " : " has no file for ";
}

// Checks the files needed from the reference frame to the frames to render.
struct Followed {
    const Region& region;
    const RegionPlan& plan;
    const ShotPlan& shot;
    const FrameReader& plate;
    FrameSpan span;

    [[nodiscard]] Status check_plate() const {
        const auto gaps = gaps_in(plate.frames(), span);
        if (gaps.empty()) return {};
        return fail(ErrorCode::kMissingFrames,
                    "The plate has no " + gaps_text(gaps) +
                        ", which the surface has to be followed through from its reference frame " +
                        std::to_string(plan.reference_frames.front()) + ".",
                    around_gap(region, plan, shot, plate, plate.frames()));
    }

    // Where the plate repeats a frame in place of a missing one, its other files are repeated too.
    [[nodiscard]] Status check(const std::string& text, const char* what) const {
        WEFT_TRY(files, matte_files(text, plate));
        if (files.is_single()) return {};
        WEFT_TRY(present, files.list_frames());
        std::vector<int> usable;
        for (const int frame : plate.frames()) {
            if (std::binary_search(present.begin(), present.end(), frame) ||
                (plate.shown_frame(frame) != frame &&
                 std::binary_search(present.begin(), present.end(), plate.shown_frame(frame))))
                usable.push_back(frame);
        }
        const auto gaps = gaps_in(usable, span);
        if (gaps.empty()) return {};
        return fail(ErrorCode::kMissingFrames,
                    std::string(what) + " " + text + lacks(files) + gaps_text(gaps) +
                        ", which the surface has to be followed through from its reference frame " +
                        std::to_string(plan.reference_frames.front()) + ".",
                    around_gap(region, plan, shot, plate, usable));
    }
};

// Where the plate repeats a frame in place of a missing one, its other files are repeated too.
Status check_pattern(const std::string& text, const char* what, const std::vector<int>& wanted,
                     const FrameReader& plate, const std::string& remedy) {
    WEFT_TRY(files, matte_files(text, plate));
    if (files.is_single()) return {};
    WEFT_TRY(present, files.list_frames());
    std::vector<int> missing = missing_in(wanted, present);
    std::erase_if(missing, [&](int frame) {
        return plate.shown_frame(frame) != frame &&
               std::binary_search(present.begin(), present.end(), plate.shown_frame(frame));
    });
    if (missing.empty()) return {};
    return fail(ErrorCode::kMissingFrames,
                std::string(what) + " " + text + lacks(files) + frames_text(missing) + ".", remedy);
}

Status check_pattern(const std::string& text, const char* what, const std::vector<int>& wanted,
                     const FrameReader& plate) {
    return check_pattern(
        text, what, wanted, plate,
        "Add the files, or render only the frames that have one" + by({{setting::kFrames}}) + ".");
}

// The frames whose motion file is read: all of the span except the one where motion would leave it.
std::vector<int> motion_frames(const RegionPlan& plan, const FrameSpan& span) {
    return plan.motion_forward ? frames_between(span.first, span.last - 1)
                               : frames_between(span.first + 1, span.last);
}

}  // namespace

Expected<FrameSpan> run_around(const Region& region, const FrameReader& plate, int reference,
                               int reach, const std::vector<int>& leave_out) {
    std::vector<int> frames = plate.frames();
    std::vector<std::string> patterns{region.matte->files, region.motion.files};
    for (const MatteSource& holdout : *region.holdouts)
        patterns.push_back(holdout.files);
    for (const std::string& pattern : patterns) {
        WEFT_TRY(left, frames_with_files(pattern, plate, std::move(frames)));
        frames = std::move(left);
    }
    std::vector<SequencePattern> files;
    for (const std::string& text : patterns) {
        if (text.empty()) continue;
        WEFT_TRY(pattern, SequencePattern::parse(text));
        if (!pattern.is_single()) files.push_back(std::move(pattern));
    }
    const auto has = [&](int f) {
        std::error_code ignored;
        return std::binary_search(frames.begin(), frames.end(), f) &&
               std::filesystem::exists(plate.path_of(f), ignored) &&
               std::all_of(files.begin(), files.end(), [&](const SequencePattern& pattern) {
                   return std::filesystem::exists(pattern.path_for(f), ignored);
               });
    };
    const auto wanted = [&](int f) {
        return std::find(leave_out.begin(), leave_out.end(), f) == leave_out.end();
    };
    FrameSpan run{reference, reference};
    while (run.first > reference - reach && wanted(run.first - 1) && has(run.first - 1))
        --run.first;
    while (run.last < reference + reach && wanted(run.last + 1) && has(run.last + 1))
        ++run.last;
    return run;
}

namespace {

// The files that a frame's focus is read from, besides the plate.
std::vector<std::string> focus_files(const Region& region) {
    std::vector<std::string> out{region.matte->files, region.finish.depth, region.light.albedo,
                                 region.light.lighting};
    for (const MatteSource& holdout : *region.holdouts)
        out.push_back(holdout.files);
    for (const Zone& zone : *region.zones)
        if (zone.kind == ZoneKind::kDetail) out.push_back(zone.matte.files);
    return out;
}

}  // namespace

Expected<std::vector<int>> focus_frames(const Region& region, const RegionPlan& plan,
                                        const FrameReader& plate,
                                        const std::vector<int>& leave_out) {
    if (!(plan.focus > 0)) return std::vector<int>{};
    std::vector<int> frames = plate.frames();
    for (const std::string& pattern : focus_files(region)) {
        WEFT_TRY(left, frames_with_files(pattern, plate, std::move(frames)));
        frames = std::move(left);
    }
    FrameSpan run{std::numeric_limits<int>::min(), std::numeric_limits<int>::max()};
    if (focus_needs_propagation(plan)) {
        const int all = plate.frames().back() - plate.frames().front() + 1;
        WEFT_TRY(around, run_around(region, plate, plan.reference_frames.front(), all, leave_out));
        run = around;
    }
    std::erase_if(frames, [&](int frame) {
        std::error_code ignored;  // a link may lead nowhere
        return frame < run.first || frame > run.last ||
               std::find(leave_out.begin(), leave_out.end(), frame) != leave_out.end() ||
               !std::filesystem::exists(plate.path_of(frame), ignored);
    });
    return frames;
}

Expected<std::vector<int>> grain_frames(const Region& region, const RegionPlan& plan,
                                        const FrameReader& plate,
                                        const std::vector<int>& leave_out) {
    if (!(plan.grain > 0)) return std::vector<int>{};
    constexpr int kReach = 3;
    const int reference = plan.reference_frames.front();
    WEFT_TRY(run, run_around(region, plate, reference, kReach, leave_out));
    if (run.last == reference) return std::vector<int>{};
    return frames_between(reference, run.last);
}

Expected<std::vector<int>> shutter_frames(const Region& region, const RegionPlan& plan,
                                          const FrameReader& plate,
                                          const std::vector<int>& leave_out) {
    if (plan.shutter_deg == 0.0f || plan.temporal != TemporalMode::kLocked)
        return std::vector<int>{};
    constexpr int kMeasured = 6;
    const int reference = plan.reference_frames.front();
    WEFT_TRY(run,
             run_around(region, plate, reference, plan.shutter_deg ? 1 : kMeasured, leave_out));
    if (run.last == reference) return std::vector<int>{};
    return frames_between(reference, run.last);
}

Expected<FrameRange> calm_span(const Region& region, const RegionPlan& plan,
                               const FrameReader& plate, const std::vector<int>& leave_out) {
    const bool calms = std::any_of(plan.zones.begin(), plan.zones.end(), [](const ZonePlan& zone) {
        return zone.kind == ZoneKind::kCalmer;
    });
    if (!calms || plan.temporal != TemporalMode::kLocked) return FrameRange{};
    const int all = plate.frames().back() - plate.frames().front() + 1;
    WEFT_TRY(run, run_around(region, plate, plan.reference_frames.front(), all, leave_out));
    return FrameRange{run.first, run.last + 1};
}

namespace {

// At most so many frames, evenly spread about the reference frame.
Expected<std::vector<int>> spread_around(const Region& region, const RegionPlan& plan,
                                         const FrameReader& plate, int most,
                                         const std::vector<int>& leave_out) {
    const int reference = plan.reference_frames.front();
    WEFT_TRY(run, run_around(region, plate, reference, kEvidenceReach, leave_out));
    const auto [first, last] = run;
    const int steps = std::min(last - first, most - 1);
    std::vector<int> chosen{first};
    for (int k = 1; k <= steps; ++k)
        chosen.push_back(first + (last - first) * k / steps);
    return chosen;
}

}  // namespace

Expected<std::vector<int>> light_evidence(const Region& region, const RegionPlan& plan,
                                          const ShotPlan& shot, const FrameReader& plate,
                                          const std::vector<int>& leave_out) {
    if (!plan.estimates_light() || shot.quality == FlowQuality::kDraft) return std::vector<int>{};
    constexpr int kMostFrames = 20;
    return spread_around(region, plan, plate, kMostFrames, leave_out);
}

Expected<std::vector<int>> gloss_evidence(const Region& region, const RegionPlan& plan,
                                          const FrameReader& plate,
                                          const std::vector<int>& leave_out) {
    const bool follows = plan.temporal == TemporalMode::kLocked;
    if (!follows || !plan.estimates_light() || !(plan.highlights > 0)) return std::vector<int>{};
    constexpr int kMostFrames = 16;
    return spread_around(region, plan, plate, kMostFrames, leave_out);
}

Expected<std::vector<int>> form_evidence(const Region& region, const RegionPlan& plan,
                                         const FrameReader& plate,
                                         const std::vector<int>& leave_out) {
    if (plan.form_from == RegionPlan::FormFrom::kNothing) return std::vector<int>{};
    constexpr int kOthers = 11;
    const int reference = plan.reference_frames.front();
    std::vector<int> chosen{reference};
    if (plan.form_from == RegionPlan::FormFrom::kShape ||
        plan.form_from == RegionPlan::FormFrom::kOutline)
        return chosen;
    if (reads_form(plan.form_from)) {
        WEFT_TRY(pattern, SequencePattern::parse(form_files(region).pattern));
        if (pattern.is_single()) return chosen;
    }
    WEFT_TRY(run, run_around(region, plate, reference, kEvidenceReach, leave_out));
    const int others = std::min(run.last - run.first, kOthers);
    for (int k = 0; k <= others; ++k) {
        const int frame = others > 0 ? run.first + (run.last - run.first) * k / others : reference;
        if (frame != reference) chosen.push_back(frame);
    }
    return chosen;
}

std::string frames_list(const std::vector<int>& frames) {
    const std::string list = format_frame_list(frames);
    constexpr std::size_t kLongest = 80;
    return list.size() <= kLongest ? list : list.substr(0, list.rfind(',', kLongest)) + ",…";
}

std::string frames_text(const std::vector<int>& frames) {
    return (frames.size() == 1 ? "frame " : "frames ") + frames_list(frames);
}

Expected<std::vector<int>> frames_of_shot(const std::string& list, const std::vector<int>& shot) {
    if (list.empty()) return shot;
    WEFT_TRY(wanted, parse_frame_list(list));
    const std::vector<int> lacks = missing_in(wanted, shot);
    if (lacks.empty()) return wanted;
    return fail(ErrorCode::kMissingFrames, "The shot has no " + frames_text(lacks) + ".",
                "Choose among its " + frames_text(shot) + by({{setting::kFrames}}) + ".");
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
        return fail(
            ErrorCode::kMissingFrames,
            "The plate " + project.plate.path + " has no " + frames_text(missing) + ".",
            "Choose among its " + frames_text(plate.frames()) + by({{setting::kFrames}}) + ".");
    }
    return frames;
}

Status check_files(const Region& region, const RegionPlan& plan, const ShotPlan& shot,
                   const FrameReader& plate) {
    const FrameSpan span = analysed_span(shot, plan);
    const Followed followed{region, plan, shot, plate, span};
    WEFT_CHECK_OK(followed.check_plate());
    WEFT_CHECK_OK(check_shapes(region, plate));
    // Only now, when the number of frames is limited by the plate.
    const std::vector<int> all = frames_between(span.first, span.last);
    if (!region.matte->files.empty())
        WEFT_CHECK_OK(followed.check(region.matte->files, "The matte"));
    for (const MatteSource& holdout : *region.holdouts) {
        if (!holdout.files.empty()) WEFT_CHECK_OK(followed.check(holdout.files, "The holdout"));
    }
    for (const Zone& zone : *region.zones) {
        if (zone.matte.files.empty()) continue;
        // Motion blur needs a frame beside the rendered ones, and surroundings are followed from
        // the reference frame on, as the surface is.
        WEFT_CHECK_OK(changes_motion(zone.kind)
                          ? followed.check(zone.matte.files, "The zone")
                          : check_pattern(zone.matte.files, "The zone", shot.frames, plate));
    }
    for (const std::string& pass : {region.light.albedo, region.light.lighting}) {
        if (!pass.empty()) WEFT_CHECK_OK(followed.check(pass, "The lighting pass"));
    }
    if (plan.has_uv)
        WEFT_CHECK_OK(check_pattern(region.placement.uv, "The UV pass", shot.frames, plate));
    if (reads_form(plan.form_from)) {
        const FormFiles pass = form_files(region);
        const std::string remedy =
            "The form is found from them, whichever frames are rendered. Add the files, or give "
            "that of the reference frame alone" +
            by({{setting::kPositionPass}}) + ".";
        WEFT_CHECK_OK(
            check_pattern(pass.pattern, pass.what.c_str(), plan.form_evidence, plate, remedy));
    }
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
                            frames_text(untracked) + "; it has " + frames_text(tracked) + ".",
                        "Track the whole shot, or render only the frames that it has" +
                            by({{setting::kFrames}}) + ".");
        }
    }
    if (plan.true_motion && plan.temporal != TemporalMode::kNone) {
        WEFT_CHECK_OK(
            check_pattern(region.motion.files, "The motion", motion_frames(plan, span), plate));
    }
    return {};
}

}  // namespace weft
