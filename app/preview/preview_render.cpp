// The rendering thread of the preview.
#include <algorithm>

#include "app/base/background.h"
#include "app/preview/preview_impl.h"
#include "app/preview/preview_stages.h"
#include "engine/color/color_space.h"
#include "engine/compute/backend_registry.h"
#include "engine/core/stopwatch.h"

namespace weft {
namespace {

std::map<RegionId, int> references_of(const Shot& shot) {
    std::map<RegionId, int> out;
    for (std::size_t k = 0; k < shot.references.size(); ++k)
        out[shot.project.regions[shot.region_index[k]]->id] = shot.references[k].frame;
    return out;
}

// What was measured on pictures that are rendered again.
void forget_pictures(std::map<RegionId, std::map<int, FrameHealth>>& healths) {
    for (auto& [region, of_frames] : healths)
        for (auto& [frame, health] : of_frames) {
            health.flicker = health.flicker_plate = health.flicker_floor = health.chatter =
                health.seam_motion = health.seam = -1;
            health.steps.reset();
        }
}

std::map<RegionId, std::string> samples_of(const Shot& shot) {
    std::map<RegionId, std::string> out;
    for (std::size_t k = 0; k < shot.textures.size(); ++k) {
        const ShotTexture& texture = shot.textures[k];
        if (texture.sample_reason.empty()) continue;
        out[shot.project.regions[shot.region_index[k]]->id] =
            std::string(kind_name(texture.sample_kind)) + ": " + texture.sample_reason;
    }
    return out;
}

}  // namespace

Preview::Impl::Impl(AnalysisCacheOptions cache_options, std::string library, std::size_t budget)
    : cache(std::move(cache_options)),
      files(open_fingerprints(cache)),
      texture_library(std::move(library)),
      budget_bytes(budget),
      backend(make_cpu_backend()),
      propagator(cache, files) {
    renderer = std::thread([this] { render_loop(); });
    analyser = std::thread([this] { analyse_loop(); });
}

Preview::Impl::~Impl() {
    {
        const auto shared = guarded.lock();
        shared->stop = true;
        shared->analysis_cancel.cancel();
        shared->grow_cancel.cancel();
        shared->draft_cancel.cancel();
        shared->card_cancel.cancel();
    }
    wake.notify_all();
    renderer.join();
    analyser.join();
}

void Preview::Impl::set_state(PreviewView::State state, std::string error) {
    const auto shared = guarded.lock();
    if (shared->shown.state == state && shared->shown.error == error) return;
    shared->shown.state = state;
    shared->shown.error = std::move(error);
    changed(*shared);
}

void Preview::Impl::render_loop() {
    lower_thread_priority();
    std::uint64_t seen = 0;
    for (;;) {
        {
            auto shared = guarded.lock();
            const auto signalled = [&] { return shared->stop || shared->signals != seen; };
            if (refine_pending)
                wake.wait_until(shared.lock(), shared->refine_at, signalled);
            else
                wake.wait(shared.lock(), signalled);
            if (shared->stop) return;
            seen = shared->signals;
        }
        while (step()) {
            const auto shared = guarded.lock();
            if (shared->stop) return;
        }
        release_analysis();
    }
}

// Does one piece of work; returns false if there is none.
bool Preview::Impl::step() {
    PreviewRequest now;
    std::string pixels;
    refine_pending = false;
    {
        const auto shared = guarded.lock();
        if (!shared->wanted || shared->wanted_pixels == shared->failed_pixels) return false;
        now = *shared->wanted;
        pixels = shared->wanted_pixels;
    }
    note_written(now);
    if (!current || current->pixels != pixels || current->document != now.document)
        return open_shot_of(now, pixels);
    if (!ready(now.frame)) {
        set_state(PreviewView::State::kAnalysing);
        if (step_provisional(now) || step_draft(now)) return true;
        release_analysis();
    } else if (step_frame(now)) {
        return true;
    }
    // Pictures first, then measurements.
    return step_quick_card(now) || step_fill(now, pixels) || step_card(now) || step_flicker(now);
}

// Files analysis results of in-memory mattes under the names of their files, once they are written.
void Preview::Impl::note_written(const PreviewRequest& now) {
    if (!unwritten) return;
    const PaintedMattes& were = unwritten->shot->painted;
    const auto waits = [&](const auto& matte) { return now.painted.contains(matte.first); };
    if (std::any_of(were.begin(), were.end(), waits)) return;
    unwritten->store->mattes_written(*unwritten->shot);
    unwritten.reset();
}

// Renders the visible frame: reduced at once, full size when idle.
bool Preview::Impl::step_frame(const PreviewRequest& now) {
    const int factor = factor_of(*current->shot, kProxyPixels);
    bool shown_small = false, whole = false, may_refine = false;
    {
        const auto shared = guarded.lock();
        const auto found = shared->frames.find(now.frame);
        if (found != shared->frames.end()) {
            const PreviewFrame& there = found->second;
            shown_small = !there.approximate && (!now.stages || there.stages[0]) &&
                          (!now.layer || there.layer_kind == now.layer);
            whole = shown_small && there.proxy == 1;
        }
        may_refine = !now.interactive && Clock::now() >= shared->refine_at;
    }
    if (!shown_small) return render(now, now.frame, factor);
    if (!whole && may_refine) return render(now, now.frame, 1);
    refine_pending = !whole && !now.interactive;
    set_state(PreviewView::State::kIdle);
    return draw_overlay(now);
}

bool Preview::Impl::step_fill(const PreviewRequest& now, const std::string& pixels) {
    const int factor = factor_of(*current->shot, kProxyPixels);
    for (const int frame : now.fill) {
        {
            const auto shared = guarded.lock();
            if (shared->wanted_pixels != pixels) return true;
            const auto found = shared->frames.find(frame);
            if (found != shared->frames.end() && !found->second.approximate) continue;
            if (shared->frame_bytes +
                    shared->frame_bytes / std::max<std::size_t>(1, shared->frames.size()) >
                budget_bytes)
                return false;
        }
        if (ready(frame)) return render(now, frame, factor);
    }
    return false;
}

// One reader serves all versions of a shot, so decoded frames are cached once.
Expected<std::shared_ptr<const Shot>> Preview::Impl::open(const Project& project,
                                                          const PaintedMattes& painted) {
    OpenShotOptions options;
    options.painted = painted;
    options.files = files;
    options.texture_library = texture_library;
    options.cache_bytes = std::size_t{192} << 20;
    options.visibility = visibility;
    if (reader && reader_of == project.plate) options.plate = reader;
    auto shot = open_shot(project, options);
    if (shot && reader != (*shot)->plate) {
        reader = (*shot)->plate;
        reader_of = project.plate;
        proxies = std::make_unique<ProxyPlates>(std::size_t{128} << 20);
    }
    return shot;
}

bool Preview::Impl::open_shot_of(const PreviewRequest& now, const std::string& pixels) {
    set_state(PreviewView::State::kOpening);
    auto fresh = std::make_shared<OpenedShot>(
        OpenedShot{nullptr, nullptr, pixels, analysis_key(now.project), now.document, now.project});
    std::vector<std::string> warnings;
    auto shot = open(now.project, now.painted);
    Expected<std::shared_ptr<AnalysisCache>> store{nullptr};
    if (shot && current && current->analysis == fresh->analysis) {
        store = current->store;
    } else if (shot) {
        store = open_analysis_cache(**shot, cache, warnings);
    }
    if (!shot || !store) {
        set_state(PreviewView::State::kFailed, (shot ? store.error() : shot.error()).text());
        const auto shared = guarded.lock();
        shared->failed_pixels = pixels;
        return false;
    }
    fresh->shot = *shot;
    fresh->store = *store;
    warnings.insert(warnings.end(), (*shot)->warnings.begin(), (*shot)->warnings.end());
    if (auto t = make_color_transform((*shot)->spaces.out, {"srgb"})) srgb_from_out = *t;
    if (auto t = make_color_transform((*shot)->spaces.out, {"linear"})) linear_from_out = *t;
    const bool same_analysis =
        current && current->analysis == fresh->analysis && current->document == fresh->document;
    // If the analysis is unchanged, the store is still that of the shot opened before.
    if (!same_analysis && current && !ready_frames.empty()) settled = current;
    if (settled &&
        (settled->shot->project.plate != now.project.plate || settled->document != now.document))
        settled.reset();
    if (!same_analysis) {
        unwritten = fresh->shot->painted.empty() ? nullptr : fresh;
        ready_frames.clear();
        draft.reset();
    }
    // Destroyed after the lock is released, because pictures are large.
    std::map<int, PreviewFrame> old_frames;
    OpenedPtr old_opened;
    const auto shared = guarded.lock();
    old_opened = std::exchange(shared->opened, fresh);
    current = fresh;
    old_frames.swap(shared->frames);
    shared->frame_bytes = 0;
    shared->provisional.reset();
    compared.clear();
    forget_pictures(shared->healths);
    shared->shown.warnings = std::move(warnings);
    shared->shown.references = references_of(**shot);
    shared->shown.samples = samples_of(**shot);
    noted_forms.clear();
    changed(*shared);
    if (!same_analysis) {
        shared->confidences.clear();
        shared->healths.clear();
        shared->shown.done = shared->shown.total = 0;
        shared->shown.seconds_left = 0;
        ++mattes;
    }
    const std::vector<int> range = now.range.empty() ? std::vector<int>{now.frame} : now.range;
    if (!same_analysis || shared->analyse_frames != range)
        begin_analysis(*shared, now.frame, range);
    return true;
}

// Of the shot just opened; it waits for the first picture.
void Preview::Impl::begin_analysis(Shared& of, int frame, const std::vector<int>& range) {
    if (of.analysing_key != of.opened->analysis) of.analysis_cancel.cancel();
    of.to_analyse = of.opened;
    of.analyse_first = {frame};
    of.analyse_frames = range;
    of.analysis_pending = of.analysis_held = true;
}

bool Preview::Impl::ready(int frame) {
    if (ready_frames.contains(frame)) return true;
    const std::vector<int>& there = current->shot->plate->frames();
    if (!std::binary_search(there.begin(), there.end(), frame)) return false;
    if (steps_to(*current, {frame}) > 0) return false;
    ready_frames.insert(frame);
    return true;
}

// Synthesizes the missing planes of a shot. Returns false after a failure, which is shown.
bool Preview::Impl::grow(const OpenedShot& of) {
    CancelToken token;
    {
        const auto shared = guarded.lock();
        if (!current || shared->wanted_pixels != current->pixels) return true;
        shared->grow_cancel = token;
    }
    const Status grown = scenes.grow_one(*of.shot, *of.store, of.analysis, token);
    if (grown || token.cancelled()) return true;
    set_state(PreviewView::State::kFailed, grown.error().text());
    const auto shared = guarded.lock();
    shared->failed_pixels = of.pixels;
    return false;
}

void Preview::Impl::note_seam(int frame, float seam) {
    const Shot& shot = *current->shot;
    const auto shared = guarded.lock();
    for (const std::size_t k : shot.region_index)
        shared->healths[shot.project.regions[k]->id][frame].seam = seam;
}

bool Preview::Impl::render(const PreviewRequest& now, int frame, int factor) {
    const bool usable = scenes.adopt(*current->shot, current->analysis);
    CancelToken token;
    const bool first_look = [&] {
        const auto shared = guarded.lock();
        shared->grow_cancel = token;
        // A provisional picture serves as well while the texture is synthesized.
        const bool shown = shared->frames.contains(frame) ||
                           (shared->provisional && shared->provisional_frame == frame);
        return frame == now.frame && !shown && shared->wanted_pixels == current->pixels;
    }();
    if (!scenes.exact() && !first_look) {
        set_state(PreviewView::State::kGrowing);
        return grow(*current);
    }
    if (frame == now.frame) set_state(PreviewView::State::kRendering);
    const auto start = Clock::now();
    float seam = -1;
    auto made = usable ? pictures_of({*current->shot, *current->store, scenes.scenes()}, frame,
                                     now.stages && frame == now.frame, factor,
                                     frame == now.frame ? now.layer : std::nullopt, &seam)
                       : quick_picture(now, factor, token);
    if (!made && token.cancelled()) return true;
    if (!made) {
        set_state(PreviewView::State::kFailed,
                  "Frame " + std::to_string(frame) + ": " + made.error().text());
        const auto shared = guarded.lock();
        shared->failed_pixels = current->pixels;
        return false;
    }
    made->approximate = !scenes.exact();
    if (scenes.exact()) note_seam(frame, seam);
    note_forms();
    note_lights(frame);
    made->places = places_on(frame);
    keep(now, frame, std::move(*made), seconds_since(start));
    return true;
}

bool Preview::Impl::draw_overlay(const PreviewRequest& now) {
    if (now.overlay == Overlay::kNone || now.overlay_region == 0) {
        const auto shared = guarded.lock();
        if (shared->overlay) changed(*shared);
        shared->overlay.reset();
        overlay_key.clear();
        return false;
    }
    const std::string key = current->pixels + " " + std::to_string(static_cast<int>(now.overlay)) +
                            " " + std::to_string(now.overlay_region) + " " +
                            std::to_string(now.frame);
    if (key == overlay_key) return false;
    const Shot& shot = *current->shot;
    if (!scenes.adopt(shot, current->analysis)) return false;
    for (std::size_t k = 0; k < shot.region_index.size(); ++k) {
        if (shot.project.regions[shot.region_index[k]]->id != now.overlay_region) continue;
        auto made = overlays.make(now.overlay, shot, *current->store, scenes.scenes()[k],
                                  static_cast<int>(k), now.frame, {});
        const auto shared = guarded.lock();
        shared->overlay = made ? std::make_shared<const OverlayPicture>(std::move(*made)) : nullptr;
        changed(*shared);
    }
    overlay_key = key;
    return true;
}

}  // namespace weft
