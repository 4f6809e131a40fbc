// First pictures: of a frame that has not been analysed, or whose texture has not been synthesized.
#include <algorithm>

#include "app/preview/preview_impl.h"

namespace weft {

void Preview::Impl::release_analysis() {
    const auto shared = guarded.lock();
    if (!std::exchange(shared->analysis_held, false)) return;
    wake.notify_all();
}

void Preview::Impl::note_first(Shared& of, int frame) {
    if (!of.wanted || of.wanted->frame != frame) return;
    if (std::exchange(of.first_shown, true)) return;
    of.shown.first_seconds = std::chrono::duration<double>(Clock::now() - of.requested_at).count();
}

// What stands in for a frame's analysis: that of the settings before the last edits, and a draft.
std::vector<EarlierAnalysis> Preview::Impl::stand_ins(const OpenedShot& of) const {
    std::vector<EarlierAnalysis> out;
    if (settled) {
        const Shot& then = *settled->shot;
        EarlierAnalysis& earlier = out.emplace_back();
        earlier = {&then.plan, settled->store.get(), {}};
        for (const std::size_t index : of.shot->region_index) {
            const RegionId id = of.shot->project.regions[index]->id;
            const auto same =
                std::find_if(then.region_index.begin(), then.region_index.end(),
                             [&](std::size_t k) { return then.project.regions[k]->id == id; });
            earlier.region_of.push_back(same == then.region_index.end()
                                            ? -1
                                            : static_cast<int>(same - then.region_index.begin()));
        }
    }
    if (draft && draft_of == of.analysis) out.push_back(draft->as_earlier());
    return out;
}

// Light that was estimated for other textures of the same analysis is used again.
Expected<ProvisionalFrame> Preview::Impl::provisional_of(const OpenedShot& of, int frame,
                                                         const CancelToken& cancel) {
    const std::uint64_t visits = guarded.lock()->visits;
    const Shot& shot = *of.shot;
    const bool served = kept_provisional && kept_provisional->analysis == of.analysis &&
                        kept_provisional->frame == frame && kept_provisional->visits == visits;
    if (!served) {
        kept_provisional.reset();
        WEFT_TRY(made, provisional_frame(*shot.source, shot.plan, *of.store, frame, stand_ins(of),
                                         cancel));
        kept_provisional = KeptProvisional{of.analysis, frame, visits, of.store, std::move(made)};
    }
    const ProvisionalFrame& before = kept_provisional->made;
    WEFT_TRY(made, provisional_frame(*shot.source, shot.plan, *before.store, frame, {}, cancel));
    // What was left out has an empty matte in that store.
    for (std::size_t k = 0; k < made.shown.size(); ++k)
        made.shown[k] = made.shown[k] && before.shown[k];
    return made;
}

// Whether the present provisional picture has the same regions, for the same request.
bool Preview::Impl::shows_already(const PreviewRequest& now, const std::vector<bool>& shown) {
    const auto shared = guarded.lock();
    const std::optional<PreviewFrame>& before = shared->provisional;
    return before && shared->provisional_frame == now.frame && shown == shown_provisionally &&
           (!now.stages || before->stages[0]) && (!now.layer || before->layer_kind == now.layer);
}

// A picture of the requested frame with quickly synthesized textures; provisional if the frame has
// not been analysed, and empty if nothing of it, or nothing more, can be shown yet.
Expected<PreviewFrame> Preview::Impl::quick_picture(const PreviewRequest& now, int factor,
                                                    const CancelToken& cancel) {
    Shot shot = *current->shot;
    std::vector<bool> shown(shot.plan.regions.size(), true);
    std::unique_ptr<AnalysisStore> alone;
    const bool provisional = !ready(now.frame);
    if (provisional) {
        WEFT_TRY(made, provisional_of(*current, now.frame, cancel));
        if (!made.shows_anything() || shows_already(now, made.shown)) return PreviewFrame();
        shot.plan = std::move(made.plan);
        shown = std::move(made.shown);
        shown_provisionally = shown;
        alone = std::move(made.store);
    }
    const AnalysisStore& store = alone ? *alone : *current->store;
    WEFT_TRY(made, scenes.quick(shot, shot.plan, store, now.frame, shown, kProxyPixels, cancel));
    WEFT_TRY(picture,
             pictures_of({shot, store, made}, now.frame, now.stages, factor, now.layer, nullptr));
    picture.approximate = true;
    picture.provisional = provisional;
    picture.partial = std::find(shown.begin(), shown.end(), false) != shown.end();
    return picture;
}

// Tries once for each request, and again when the analysis has passed the frame and may show more.
// A failure is not shown: the analysis will meet it too.
bool Preview::Impl::step_provisional(const PreviewRequest& now) {
    CancelToken token;
    std::string key = current->pixels + " " + std::to_string(now.frame) +
                      (now.stages ? " s" : " ") +
                      (now.layer ? std::to_string(static_cast<int>(*now.layer)) : "");
    {
        const auto shared = guarded.lock();
        if (now.interactive || shared->frames.contains(now.frame)) return false;
        key += " " + std::to_string(shared->visits);
        if (shared->wanted_pixels != current->pixels || key == tried_provisional) return false;
        shared->grow_cancel = token;
    }
    auto made = quick_picture(now, factor_of(*current->shot, kProxyPixels), token);
    if (token.cancelled()) return true;
    tried_provisional = std::move(key);
    if (made && made->stages[static_cast<std::size_t>(Stage::kFinal)])
        keep_provisional(now, std::move(*made));
    return true;
}

// Regions that a provisional picture of the requested frame lacks are followed to it in draft
// quality, which takes a fraction of the time of their analysis. Once for each frame.
bool Preview::Impl::step_draft(const PreviewRequest& now) {
    const std::string key = current->analysis + " " + std::to_string(now.frame);
    if (key == tried_draft || now.interactive || !kept_provisional ||
        kept_provisional->analysis != current->analysis || kept_provisional->frame != now.frame)
        return false;
    std::vector<bool> missing = kept_provisional->made.shown;
    missing.flip();
    tried_draft = key;
    if (std::find(missing.begin(), missing.end(), true) == missing.end()) return false;
    CancelToken token;
    {
        const auto shared = guarded.lock();
        if (!shared->wanted || shared->wanted->frame != now.frame ||
            shared->wanted_analysis != current->analysis)
            return true;
        shared->draft_cancel = token;
    }
    const Shot& shot = *current->shot;
    auto made = draft_analysis(*shot.source, shot.plan, now.frame, missing, token);
    if (!made) return true;
    draft = std::move(*made);
    draft_of = current->analysis;
    kept_provisional.reset();
    tried_provisional.clear();
    return true;
}

void Preview::Impl::keep_provisional(const PreviewRequest& now, PreviewFrame made) {
    std::optional<PreviewFrame> old;  // freed after the lock is: pictures are large
    const auto shared = guarded.lock();
    if (shared->frames.contains(now.frame)) return;
    old = std::exchange(shared->provisional, std::move(made));
    shared->provisional_frame = now.frame;
    note_first(*shared, now.frame);
    changed(*shared);
}

}  // namespace weft
