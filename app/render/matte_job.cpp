#include <algorithm>

#include "app/exchange/input_files.h"
#include "app/render/render_job.h"
#include "app/shot/frame_plan.h"
#include "engine/core/setting.h"
#include "engine/mask/keyframe_advice.h"
#include "engine/media/frame_writer.h"
#include "engine/media/sequence_pattern.h"
#include "engine/pipeline/matte_pass.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

// Checks that the folder exists and every file may be written.
Status prepare_output(const Shot& shot, const SequencePattern& pattern, const WriteRule& rule) {
    const std::vector<int>& frames = shot.plan.frames;
    if (pattern.is_single() && frames.size() > 1) {
        return fail(ErrorCode::kUsage, "The output " + pattern.text() + " has no frame number.",
                    "Write it like 'mattes/####.png'.");
    }
    WEFT_CHECK_OK(make_folder_of(pattern.path_for(frames.front()), rule));
    for (const int frame : frames)
        WEFT_CHECK_OK(check_output(pattern.path_for(frame), rule));
    return {};
}

void mark_suggestions(std::vector<MatteResult>& results) {
    std::vector<FrameConfidence> frames;
    std::vector<int> painted;
    for (const MatteResult& r : results) {
        frames.push_back({r.frame, r.confidence});
        if (r.painted) painted.push_back(r.frame);
    }
    if (painted.empty()) return;
    const std::vector<int> suggested = suggest_keyframes(std::move(frames), painted);
    for (MatteResult& r : results)
        r.suggested = std::find(suggested.begin(), suggested.end(), r.frame) != suggested.end();
}

bool is_empty(const Matte& matte) {
    return matte_bounds(matte).empty();
}

// The frames from which on a matte is lost because a new scene begins there, or before which it is,
// propagated backwards. `lost`: ascending.
std::vector<int> cuts_beside(const Shot& shot, const std::vector<int>& lost) {
    const auto is_lost = [&](int frame) {
        return std::binary_search(lost.begin(), lost.end(), frame);
    };
    std::vector<int> first;  // of the new scene, at either end of what is lost
    for (const int frame : lost) {
        if (!is_lost(frame - 1)) first.push_back(frame);
        if (!is_lost(frame + 1)) first.push_back(frame + 1);
    }
    // They may not have been read, if the mattes were found before.
    for (const int frame : first)
        for (const int at : {frame - 1, frame})
            static_cast<void>(shot.source->plate(at));
    const std::vector<int> cuts = shot.cuts->cuts();
    std::erase_if(first,
                  [&](int frame) { return !std::binary_search(cuts.begin(), cuts.end(), frame); });
    return first;
}

std::string cut_warning(const std::vector<int>& cuts) {
    return "A new scene begins at " + frames_text(cuts) +
           ". The matte is not propagated across a cut: it is empty there, with confidence 0. Add "
           "a "
           "keyframe in each scene that shows the surface" +
           by({{setting::kMatte}}) + ".";
}

std::string doubt_warning(const std::vector<int>& frames) {
    return "On " + frames_text(frames) +
           " too little of the keyframe's scene is found again, as after a dissolve, a cut "
           "between scenes that look alike, or a move that changes all of the picture: the matte "
           "is followed there with confidence 0. Check "
           "it, and add a keyframe where the surface is in the picture" +
           by({{setting::kMatte}}) + ".";
}

// `lost`: the frames without matte and confidence; `doubted`: those with a matte and no confidence.
void warn_of_scenes(const Shot& shot, const std::vector<int>& lost, const std::vector<int>& doubted,
                    std::vector<std::string>& warnings) {
    if (const std::vector<int> cuts = cuts_beside(shot, lost); !cuts.empty())
        warnings.push_back(cut_warning(cuts));
    if (!doubted.empty()) warnings.push_back(doubt_warning(doubted));
}

}  // namespace

Expected<std::vector<MatteResult>> run_matte_job(const JobSpec& spec,
                                                 const std::string& pattern_text,
                                                 const CancelToken& cancel,
                                                 const ProgressFn& progress,
                                                 std::vector<std::string>& warnings) {
    use_threads(spec.threads);
    WEFT_TRY(pattern, SequencePattern::parse(pattern_text));
    OpenShotOptions options;
    options.textures = false;
    options.watch_inputs = true;
    options.files = open_fingerprints(spec.cache);
    WEFT_TRY(shot, open_shot(spec.project, options));
    const ShotPlan& plan = shot->plan;
    if (plan.regions.size() != 1)
        return fail(ErrorCode::kUsage, "Mattes are made for one region at a time.");
    WriteRule rule;
    WEFT_TRY(fence, make_fence(spec.project, spec.limits));
    rule.fence = fence;
    rule.existing = existing_by(spec.existing == ExistingFrames::kOverwrite);
    WEFT_CHECK_OK(prepare_output(*shot, pattern, rule));

    warnings.insert(warnings.end(), shot->warnings.begin(), shot->warnings.end());
    WEFT_TRY(store, open_analysis_cache(*shot, spec.cache, warnings));
    ProgressEvent event{WorkStage::kAnalyse, 0, count_matte_steps(plan, *store), 0, 0};
    const PassContext context{*shot->source, plan, cancel, [&](int frame, double seconds) {
                                  ++event.done;
                                  event.frame = frame;
                                  event.seconds = seconds;
                                  if (progress) progress(event);
                              }};
    WEFT_CHECK_OK(propagate_mattes(context, *store));

    std::vector<MatteResult> results;
    std::vector<int> lost, doubted;
    for (const int frame : plan.frames) {
        if (cancel.cancelled()) return cancelled(cancel);
        StoredMatte matte;
        if (plan.regions[0].propagated()) {
            WEFT_TRY(bytes, store->get({0, frame, AnalysisKind::kMatte}));
            WEFT_TRY(stored, decode_matte(bytes));
            matte = std::move(stored);
        } else {
            WEFT_TRY(read, shot->source->matte(0, frame));
            matte.matte = std::move(read);
        }
        if (matte.confidence == 0) (is_empty(matte.matte) ? lost : doubted).push_back(frame);
        const std::vector<int>& keys = plan.regions[0].matte_keys;
        results.push_back({frame, pattern.path_for(frame), matte.confidence,
                           std::binary_search(keys.begin(), keys.end(), frame)});
        const Matte edged = with_edge(std::move(matte.matte), plan.regions[0].matte_edge.at(frame));
        WEFT_CHECK_OK(write_matte(results.back().path, edged, rule));
    }
    warn_of_scenes(*shot, lost, doubted, warnings);
    WEFT_CHECK_OK(check_unchanged(shot->inputs->changed()));
    const std::vector<std::string> remarks = store->remarks();
    warnings.insert(warnings.end(), remarks.begin(), remarks.end());
    mark_suggestions(results);
    return results;
}

}  // namespace weft
