// The analysis thread of the preview.
#include "app/base/background.h"
#include "app/cache/analysis_claim.h"
#include "app/preview/preview_impl.h"
#include "app/preview/propagation_key.h"
#include "engine/core/stopwatch.h"
#include "engine/mask/plate_edge.h"
#include "engine/pipeline/analyse.h"
#include "engine/pipeline/matte_pass.h"

namespace weft {
namespace {

ShotPlan plan_for(const OpenedShot& opened, std::vector<int> frames) {
    ShotPlan plan = opened.shot->plan;
    plan.frames = std::move(frames);
    return plan;
}

}  // namespace

int steps_to(const OpenedShot& opened, std::vector<int> frames, bool anew) {
    const ShotPlan plan = plan_for(opened, std::move(frames));
    if (anew) return static_cast<int>(count_analysis_steps(plan, MemoryAnalysisStore()));
    return static_cast<int>(count_analysis_steps(plan, *opened.store));
}

std::optional<int> stored_layer(const Region& region, int layer) {
    if (layer == 0 && region.matte->keyframes.empty()) return std::nullopt;
    if (layer == 0) return 0;
    if (is_zone_layer(layer)) {
        const auto zone = static_cast<std::size_t>(zone_of_layer(layer));
        if (zone >= region.zones->size() || (*region.zones)[zone].matte.by_frame())
            return std::nullopt;
        return layer;
    }
    const std::vector<MatteSource>& holdouts = *region.holdouts;
    const auto at = static_cast<std::size_t>(layer) - 1;
    if (at >= holdouts.size() || holdouts[at].by_frame()) return std::nullopt;
    int painted = 1;
    for (std::size_t k = 0; k < at; ++k)
        painted += holdouts[k].by_frame() ? 0 : 1;
    return painted;
}

namespace {

// Where a shot that was opened from `asked` stores that matte; nothing: it is another one.
std::optional<AnalysisKey> place_of(const Project& asked, const Shot& shot,
                                    const WantedMatte& wanted) {
    for (std::size_t k = 0; k < shot.region_index.size(); ++k) {
        const Region& region = *asked.regions[shot.region_index[k]];
        if (region.id != wanted.region) continue;
        const std::optional<int> stored = stored_layer(region, wanted.layer);
        if (!stored || propagation_key(asked, region, wanted.layer) != wanted.key) break;
        const auto kind = wanted.walk == WantedMatte::Walk::kAll ? AnalysisKind::kMatte
                                                                 : AnalysisKind::kMatteForward;
        return AnalysisKey{static_cast<int>(k), wanted.frame, kind, *stored};
    }
    return std::nullopt;
}

}  // namespace

Expected<Matte> matte_in(const Project& asked, const Shot& shot, const AnalysisStore& store,
                         const WantedMatte& wanted) {
    const auto place = place_of(asked, shot, wanted);
    if (!place)
        return fail(ErrorCode::kMissingFrames, "The matte has not been propagated to frame " +
                                                   std::to_string(wanted.frame) + " yet.");
    WEFT_TRY(bytes, store.get(*place));
    WEFT_TRY(found, decode_matte(bytes));
    const Size size = found.matte.size(), plate = shot.source->size();
    const Vec2 gain(static_cast<float>(plate.width) / static_cast<float>(size.width),
                    static_cast<float>(plate.height) / static_cast<float>(size.height));
    return enlarged(found.matte, gain, plate);
}

std::vector<int> reached_in(const Project& asked, const Shot& shot, const AnalysisStore& store,
                            const WantedMatte& wanted) {
    auto place = place_of(asked, shot, wanted);
    std::vector<int> out;
    if (!place) return out;
    for (const int frame : shot.plate->frames()) {
        place->frame = frame;
        if (store.has(*place)) out.push_back(frame);
    }
    return out;
}

// How far the analysis of the shot has come: `more` steps beyond those of `round`.
void Preview::Impl::show_steps(const OpenedShot& work, int more) {
    const auto shared = guarded.lock();
    // A step that was begun before the shot was changed may end after it.
    if (!shared->opened || shared->opened->analysis != work.analysis) return;
    const int done = std::min(round.done + more, round.total);
    PreviewView& shown = shared->shown;
    shown.analysing = true;
    shown.done = done;
    shown.total = round.total;
    const int here = done - round.begun;
    if (here > 2) shown.seconds_left = seconds_since(round.start) / here * (round.total - done);
    changed(*shared);
    ++mattes;
    signal(*shared);
}

// What the artist has just painted is looked at before its texture is.
void Preview::Impl::propagate_to(const OpenedShot& work, int frame, const CancelToken& token) {
    const ShotPlan plan = plan_for(work, work.shot->plate->frames());
    const auto step = [&](int, double) {
        ++round.done;
        show_steps(work, 0);
    };
    // A failure meets the analysis too, which shows it.
    (void)propagate_mattes_at({*work.shot->source, plan, token, step, nullptr}, *work.store, frame);
}

void Preview::Impl::analyse_loop() {
    lower_thread_priority();
    for (;;) {
        OpenedPtr work;
        std::vector<int> first, all;
        CancelToken token;
        {
            auto shared = guarded.lock();
            wake.wait(shared.lock(), [&] {
                return shared->stop ||
                       (shared->analysis_pending && !shared->paused && !shared->analysis_held);
            });
            if (shared->stop) return;
            shared->analysis_pending = false;
            work = shared->to_analyse;
            first = shared->analyse_first;
            all = shared->analyse_frames;
            shared->analysis_cancel = token;
            shared->analysing_key = work->analysis;
        }
        const int left = steps_to(*work, all), total = std::max(left, steps_to(*work, all, true));
        round = {total, total - left, total - left, Clock::now()};
        if (left > 0) show_steps(*work, 0);
        if (!first.empty()) propagate_to(*work, first.front(), token);
        // Analyse the visible frame first, unless that is nearly all of the work.
        const int for_first = steps_to(*work, first), for_all = steps_to(*work, all);
        const bool apart = for_first > 0 && 5 * for_first < 4 * for_all;
        if (apart) analyse(work, first, true, token);
        // Its walks are kept: they are walked again with the other frames, and when a pin moves.
        if (!token.cancelled()) analyse(work, all, !apart, token);
        collect_confidence(*work);
        {
            const auto shared = guarded.lock();
            shared->shown.analysing = false;
            shared->analysing_key.clear();
            changed(*shared);
            signal(*shared);
        }
        if (!token.cancelled()) collect_health(*work, token);
    }
}

// A render makes the same analysis: its frames are taken as they come. The steps to wait for: none
// of one that is paused.
int Preview::Impl::await_other(const OpenedPtr& work, const std::vector<int>& list, int total) {
    const int left = steps_to(*work, list);
    if (left < total) {
        ++guarded.lock()->visits;
        show_steps(*work, total - left);
    }
    return render_paused ? 0 : left;
}

void Preview::Impl::analyse(const OpenedPtr& work, const std::vector<int>& list, bool keep_walks,
                            const CancelToken& token) {
    ShotPlan plan = plan_for(*work, list);
    plan.walks = walks;
    plan.keep_walks = keep_walks;
    const int total = steps_to(*work, list);
    const auto claim = claim_analysis(*work->store, kEditorPatience, token,
                                      [&] { return await_other(work, list, total); });
    round.done += total - steps_to(*work, list);
    int done_here = 0;
    const auto progress = [&](const ProgressEvent& event) {
        done_here = static_cast<int>(event.done);
        {
            const auto shared = guarded.lock();
            if (shared->wanted && shared->wanted->frame == event.frame) ++shared->visits;
        }
        show_steps(*work, done_here);
    };
    const Status done = analyse_shot(*work->shot->source, plan, *work->store, token, progress);
    round.done += done_here;
    if (done || token.cancelled()) return;
    const auto shared = guarded.lock();
    if (shared->wanted_analysis != work->analysis) return;
    shared->shown.state = PreviewView::State::kFailed;
    shared->shown.error = done.error().text();
    shared->failed_pixels = shared->wanted_pixels;
    changed(*shared);
}

void Preview::Impl::collect_confidence(const OpenedShot& work) {
    for (std::size_t k = 0; k < work.shot->plan.regions.size(); ++k) {
        const Region& region = *work.shot->project.regions[work.shot->region_index[k]];
        for (int layer = -static_cast<int>(region.zones->size());
             layer <= static_cast<int>(region.holdouts->size()); ++layer) {
            const std::optional<int> stored = stored_layer(region, layer);
            if (!stored) continue;
            std::map<int, float> found;
            for (const int frame : work.shot->plate->frames()) {
                const AnalysisKey key{static_cast<int>(k), frame, AnalysisKind::kMatte, *stored};
                if (!work.store->has(key)) continue;
                const auto bytes = work.store->get(key);
                if (!bytes) continue;
                if (const auto matte = decode_matte(*bytes)) found[frame] = matte->confidence;
            }
            const auto shared = guarded.lock();
            if (work.document != shared->document) return;
            shared->confidences[{region.id, layer}] = std::move(found);
            ++mattes;
        }
    }
}

}  // namespace weft
