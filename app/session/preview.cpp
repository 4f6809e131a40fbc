#include "app/session/preview.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <set>

#include "app/session/background.h"
#include "app/session/preview_overlay.h"
#include "app/session/preview_scenes.h"
#include "app/session/shot.h"
#include "engine/color/color_space.h"
#include "engine/compute/backend_registry.h"
#include "engine/pipeline/analyse.h"
#include "engine/pipeline/matte_pass.h"
#include "engine/pipeline/render_frame.h"
#include "engine/pipeline/surface_pass.h"

namespace weft {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// A project opened for work.
struct Opened {
    std::shared_ptr<const Shot> shot;
    std::shared_ptr<AnalysisStore> store;
    std::string pixels, analysis;  // the keys of what was opened
};
using OpenedPtr = std::shared_ptr<const Opened>;

ShotPlan plan_for(const Opened& opened, std::vector<int> frames) {
    ShotPlan plan = opened.shot->plan;
    plan.frames = std::move(frames);
    return plan;
}

int steps_to(const Opened& opened, std::vector<int> frames) {
    const ShotPlan plan = plan_for(opened, std::move(frames));
    return count_matte_steps(plan, *opened.store) + count_surface_steps(plan, *opened.store);
}

// Only what was touched, on the dark surround: a stage of the way, not a composite.
void isolate(ImageF3& pixels, const Matte& touched) {
    constexpr float kGround = 0.1f;
    for (int y = 0; y < pixels.height(); ++y) {
        for (int x = 0; x < pixels.width(); ++x) {
            const float a = static_cast<float>(touched.at(x, y)) / 255.0f;
            for (int c = 0; c < 3; ++c)
                pixels.pixel(x, y)[c] = kGround + a * (pixels.pixel(x, y)[c] - kGround);
        }
    }
}

}  // namespace

struct Preview::Impl {
    Impl(AnalysisCacheOptions cache_options, std::size_t budget)
        : cache(std::move(cache_options)), budget_bytes(budget), backend(make_cpu_backend()) {
        renderer = std::thread([this] { render_loop(); });
        analyser = std::thread([this] { analyse_loop(); });
    }
    ~Impl() {
        {
            const std::lock_guard lock(mutex);
            stop = true;
            analysis_cancel.cancel();
            grow_cancel.cancel();
        }
        wake.notify_all();
        renderer.join();
        analyser.join();
    }

    // ---- the rendering thread ----
    void render_loop();
    bool step();
    bool open_shot_of(const PreviewRequest& wanted, const std::string& pixels);
    bool render(const PreviewRequest& wanted, int frame);
    bool draw_overlay(const PreviewRequest& wanted);
    bool ready(int frame);
    [[nodiscard]] Expected<PreviewFrame> pictures_of(int frame, bool stages);
    void set_state(PreviewView::State state, std::string error = {});

    // ---- the analysing thread ----
    void analyse_loop();
    void analyse(const OpenedPtr& opened, const std::vector<int>& frames, const CancelToken& token);
    void collect_confidence(const Opened& opened);

    void changed() { shown.changes = ++news; }
    void signal() {
        ++signals;
        wake.notify_all();
    }

    const AnalysisCacheOptions cache;
    const std::size_t budget_bytes;
    const std::shared_ptr<const Backend> backend;

    mutable std::mutex mutex;
    std::condition_variable wake;
    bool stop = false, paused = false;
    std::uint64_t signals = 0;

    // What is wanted.
    std::optional<PreviewRequest> wanted;
    std::string wanted_pixels, wanted_analysis;
    // What there is.
    OpenedPtr opened;
    std::string failed_pixels;  // what could not be opened or rendered
    std::map<int, PreviewFrame> frames;
    std::size_t frame_bytes = 0;
    std::shared_ptr<const OverlayPicture> overlay;
    std::string overlay_key;
    std::map<RegionId, std::map<int, float>> confidences;
    std::atomic<std::uint64_t> mattes = 0;
    PreviewView shown;
    std::atomic<std::uint64_t> news = 0;
    // What is to be analysed.
    OpenedPtr to_analyse;
    std::vector<int> analyse_frames, analyse_first;
    bool analysis_news = false;
    std::string analysing_key;
    CancelToken analysis_cancel, grow_cancel;

    // Of the rendering thread alone.
    PreviewScenes scenes;
    std::set<int> ready_frames;
    std::shared_ptr<const ColorTransform> srgb_from_out, linear_from_out;

    std::thread renderer, analyser;
};

void Preview::Impl::set_state(PreviewView::State state, std::string error) {
    const std::lock_guard lock(mutex);
    if (shown.state == state && shown.error == error) return;
    shown.state = state;
    shown.error = std::move(error);
    changed();
}

void Preview::Impl::render_loop() {
    lower_thread_priority();
    std::uint64_t seen = 0;
    for (;;) {
        {
            std::unique_lock lock(mutex);
            wake.wait(lock, [&] { return stop || signals != seen; });
            if (stop) return;
            seen = signals;
        }
        while (step()) {
            const std::lock_guard lock(mutex);
            if (stop) return;
        }
    }
}

// One piece of work; false when there is none until something happens.
bool Preview::Impl::step() {
    PreviewRequest now;
    std::string pixels, analysis;
    {
        const std::lock_guard lock(mutex);
        if (!wanted || wanted_pixels == failed_pixels) return false;
        now = *wanted;
        pixels = wanted_pixels;
        analysis = wanted_analysis;
    }
    if (!opened || opened->pixels != pixels) return open_shot_of(now, pixels);
    if (!ready(now.frame)) {
        set_state(PreviewView::State::kAnalysing);
    } else {
        const bool had = [&] {
            const std::lock_guard lock(mutex);
            const auto found = frames.find(now.frame);
            return found != frames.end() && !found->second.approximate &&
                   (!now.stages || found->second.stages[0]);
        }();
        if (!had) return render(now, now.frame);
        set_state(PreviewView::State::kIdle);
        if (draw_overlay(now)) return true;
    }
    for (const int frame : now.fill) {
        {
            const std::lock_guard lock(mutex);
            if (wanted_pixels != pixels) return true;
            const auto found = frames.find(frame);
            if (found != frames.end() && !found->second.approximate) continue;
            if (frame_bytes + frame_bytes / std::max<std::size_t>(1, frames.size()) > budget_bytes)
                return false;
        }
        if (ready(frame)) return render(now, frame);
    }
    return false;
}

bool Preview::Impl::open_shot_of(const PreviewRequest& now, const std::string& pixels) {
    set_state(PreviewView::State::kOpening);
    auto fresh = std::make_shared<Opened>();
    fresh->pixels = pixels;
    fresh->analysis = analysis_key(now.project);
    std::vector<std::string> warnings;
    auto shot = open_shot(now.project);
    Expected<std::shared_ptr<AnalysisStore>> store{nullptr};
    if (shot && opened && opened->analysis == fresh->analysis) {
        store = opened->store;
    } else if (shot) {
        store = open_analysis_cache(**shot, cache, warnings);
    }
    if (!shot || !store) {
        set_state(PreviewView::State::kFailed, (shot ? store.error() : shot.error()).text());
        const std::lock_guard lock(mutex);
        failed_pixels = pixels;
        return false;
    }
    fresh->shot = *shot;
    fresh->store = *store;
    warnings.insert(warnings.end(), (*shot)->warnings.begin(), (*shot)->warnings.end());
    if (auto t = make_color_transform((*shot)->spaces.out, {"srgb"})) srgb_from_out = *t;
    if (auto t = make_color_transform((*shot)->spaces.out, {"linear"})) linear_from_out = *t;
    const bool same_analysis = opened && opened->analysis == fresh->analysis;
    if (!same_analysis) ready_frames.clear();
    // Freed after the lock is: pictures are large.
    std::map<int, PreviewFrame> old_frames;
    OpenedPtr old_opened;
    const std::lock_guard lock(mutex);
    old_opened = std::exchange(opened, fresh);
    old_frames.swap(frames);
    frame_bytes = 0;
    shown.warnings = std::move(warnings);
    changed();
    if (!same_analysis) {
        confidences.clear();
        ++mattes;
    }
    const std::vector<int> range = now.range.empty() ? std::vector<int>{now.frame} : now.range;
    if (!same_analysis || analyse_frames != range) {
        if (analysing_key != fresh->analysis) analysis_cancel.cancel();
        to_analyse = fresh;
        analyse_first = {now.frame};
        analyse_frames = range;
        analysis_news = true;
        wake.notify_all();
    }
    return true;
}

bool Preview::Impl::ready(int frame) {
    if (ready_frames.contains(frame)) return true;
    const std::vector<int>& there = opened->shot->plate->frames();
    if (!std::binary_search(there.begin(), there.end(), frame)) return false;
    if (steps_to(*opened, {frame}) > 0) return false;
    ready_frames.insert(frame);
    return true;
}

Expected<PreviewFrame> Preview::Impl::pictures_of(int frame, bool stages) {
    const Shot& shot = *opened->shot;
    const bool eight_bit = shot.plan.display_referred && shot.plate->depth() == PixelDepth::kU8;
    const auto picture = [&](const ImageF3& pixels) {
        return make_picture(pixels, eight_bit, srgb_from_out.get(), linear_from_out.get());
    };
    PreviewFrame out;
    ShotPlan plan = shot.plan;
    WEFT_TRY(lit,
             render_frame(*shot.source, plan, scenes.scenes(), *opened->store, *backend, frame));
    out.stages[static_cast<std::size_t>(Stage::kFinal)] = picture(lit.pixels);
    if (!stages) return out;
    isolate(lit.pixels, lit.touched);
    out.stages[static_cast<std::size_t>(Stage::kLit)] = picture(lit.pixels);
    for (RegionPlan& region : plan.regions)
        region.light_source = LightSource::kNone;
    WEFT_TRY(flat,
             render_frame(*shot.source, plan, scenes.scenes(), *opened->store, *backend, frame));
    isolate(flat.pixels, flat.touched);
    out.stages[static_cast<std::size_t>(Stage::kTexture)] = picture(flat.pixels);
    return out;
}

bool Preview::Impl::render(const PreviewRequest& now, int frame) {
    const bool usable = scenes.adopt(*opened->shot, opened->analysis);
    const bool first_look = [&] {
        const std::lock_guard lock(mutex);
        return !frames.contains(frame);
    }();
    if (!usable || (!scenes.exact() && !(first_look && frame == now.frame))) {
        set_state(PreviewView::State::kGrowing);
        CancelToken token;
        {
            const std::lock_guard lock(mutex);
            if (wanted_pixels != opened->pixels) return true;
            grow_cancel = token;
        }
        const Status grown =
            scenes.grow_one(*opened->shot, *opened->store, opened->analysis, token);
        if (!grown && !token.cancelled()) {
            set_state(PreviewView::State::kFailed, grown.error().text());
            const std::lock_guard lock(mutex);
            failed_pixels = opened->pixels;
            return false;
        }
        return true;
    }
    if (frame == now.frame) set_state(PreviewView::State::kRendering);
    const auto start = Clock::now();
    auto made = pictures_of(frame, now.stages && frame == now.frame);
    if (!made) {
        set_state(PreviewView::State::kFailed,
                  "Frame " + std::to_string(frame) + ": " + made.error().text());
        const std::lock_guard lock(mutex);
        failed_pixels = opened->pixels;
        return false;
    }
    made->approximate = !scenes.exact();
    const auto bytes_of = [](const PreviewFrame& f) {
        std::size_t sum = 0;
        for (const PicturePtr& p : f.stages)
            sum += p ? p->size_bytes() : 0;
        return sum;
    };
    std::vector<PreviewFrame> gone;  // freed after the lock is: pictures are large
    const std::lock_guard lock(mutex);
    if (frames.contains(frame)) frame_bytes -= bytes_of(frames[frame]);
    frame_bytes += bytes_of(*made);
    gone.push_back(std::exchange(frames[frame], std::move(*made)));
    while (frame_bytes > budget_bytes && frames.size() > 1) {
        // The one furthest from where the artist is.
        const auto first = frames.begin(), last = std::prev(frames.end());
        const auto far =
            std::abs(first->first - now.frame) > std::abs(last->first - now.frame) ? first : last;
        frame_bytes -= bytes_of(far->second);
        gone.push_back(std::move(far->second));
        frames.erase(far);
    }
    shown.frame_seconds = seconds_since(start);
    changed();
    return true;
}

bool Preview::Impl::draw_overlay(const PreviewRequest& now) {
    if (now.overlay == Overlay::kNone || now.overlay_region == 0) {
        const std::lock_guard lock(mutex);
        if (overlay) changed();
        overlay.reset();
        overlay_key.clear();
        return false;
    }
    const std::string key = opened->pixels + " " + std::to_string(static_cast<int>(now.overlay)) +
                            " " + std::to_string(now.overlay_region) + " " +
                            std::to_string(now.frame);
    if (key == overlay_key) return false;
    const Shot& shot = *opened->shot;
    if (!scenes.adopt(shot, opened->analysis)) return false;
    for (std::size_t k = 0; k < shot.region_index.size(); ++k) {
        if (shot.project.regions[shot.region_index[k]]->id != now.overlay_region) continue;
        auto made = make_overlay(now.overlay, shot, *opened->store, scenes.scenes()[k],
                                 static_cast<int>(k), now.frame, {});
        const std::lock_guard lock(mutex);
        overlay = made ? std::make_shared<const OverlayPicture>(std::move(*made)) : nullptr;
        changed();
    }
    overlay_key = key;
    return true;
}

// ---- analysis --------------------------------------------------------------------------------

void Preview::Impl::analyse_loop() {
    lower_thread_priority();
    for (;;) {
        OpenedPtr work;
        std::vector<int> first, all;
        CancelToken token;
        {
            std::unique_lock lock(mutex);
            wake.wait(lock, [&] { return stop || (analysis_news && !paused); });
            if (stop) return;
            analysis_news = false;
            work = to_analyse;
            first = analyse_first;
            all = analyse_frames;
            analysis_cancel = token;
            analysing_key = work->analysis;
        }
        // What the artist looks at comes first, unless that is most of the work anyway.
        const int for_first = steps_to(*work, first), for_all = steps_to(*work, all);
        if (for_first > 0 && 2 * for_first < for_all) analyse(work, first, token);
        if (!token.cancelled()) analyse(work, all, token);
        collect_confidence(*work);
        const std::lock_guard lock(mutex);
        shown.analysing = false;
        analysing_key.clear();
        changed();
        signal();
    }
}

void Preview::Impl::analyse(const OpenedPtr& work, const std::vector<int>& list,
                            const CancelToken& token) {
    const ShotPlan plan = plan_for(*work, list);
    const auto start = Clock::now();
    const auto progress = [&](const ProgressEvent& event) {
        const std::lock_guard lock(mutex);
        shown.analysing = true;
        shown.done = static_cast<int>(event.done);
        shown.total = static_cast<int>(event.total);
        if (event.done > 2) {
            shown.seconds_left = seconds_since(start) / static_cast<double>(event.done) *
                                 static_cast<double>(event.total - event.done);
        }
        changed();
        ++mattes;
        signal();
    };
    const Status done = analyse_shot(*work->shot->source, plan, *work->store, token, progress);
    if (done || token.cancelled()) return;
    const std::lock_guard lock(mutex);
    if (wanted_analysis != work->analysis) return;
    shown.state = PreviewView::State::kFailed;
    shown.error = done.error().text();
    failed_pixels = wanted_pixels;
    changed();
}

void Preview::Impl::collect_confidence(const Opened& work) {
    for (std::size_t k = 0; k < work.shot->plan.regions.size(); ++k) {
        if (!work.shot->plan.regions[k].propagated()) continue;
        const RegionId id = work.shot->project.regions[work.shot->region_index[k]]->id;
        std::map<int, float> found;
        for (const int frame : work.shot->plate->frames()) {
            const AnalysisKey key{static_cast<int>(k), frame, AnalysisKind::kMatte};
            if (!work.store->has(key)) continue;
            const auto bytes = work.store->get(key);
            if (!bytes) continue;
            if (const auto matte = decode_matte(*bytes)) found[frame] = matte->confidence;
        }
        const std::lock_guard lock(mutex);
        confidences[id] = std::move(found);
        ++mattes;
    }
}

// ---- the public face -------------------------------------------------------------------------

Preview::Preview(AnalysisCacheOptions cache, std::size_t budget_bytes)
    : impl_(std::make_unique<Impl>(std::move(cache), budget_bytes)) {}
Preview::~Preview() = default;

bool Preview::try_request(const PreviewRequest& request) {
    std::string pixels = pixel_key(request.project);
    std::string analysis = analysis_key(request.project);
    std::optional<PreviewRequest> next = request;  // the one before is freed after the lock is
    const std::unique_lock lock(impl_->mutex, std::try_to_lock);
    if (!lock) return false;
    if (impl_->wanted_pixels != pixels) {
        impl_->failed_pixels.clear();
        impl_->grow_cancel.cancel();
    }
    if (!impl_->analysing_key.empty() && impl_->analysing_key != analysis)
        impl_->analysis_cancel.cancel();
    impl_->wanted.swap(next);
    impl_->wanted_pixels = std::move(pixels);
    impl_->wanted_analysis = std::move(analysis);
    impl_->signal();
    return true;
}

void Preview::clear() {
    std::map<int, PreviewFrame> old;  // freed after the lock is: pictures are large
    const std::lock_guard lock(impl_->mutex);
    impl_->wanted.reset();
    impl_->wanted_pixels.clear();
    impl_->wanted_analysis.clear();
    impl_->failed_pixels.clear();
    impl_->analysis_cancel.cancel();
    impl_->grow_cancel.cancel();
    old.swap(impl_->frames);
    impl_->frame_bytes = 0;
    impl_->overlay.reset();
    impl_->confidences.clear();
    impl_->shown = {};
    impl_->changed();
}

void Preview::pause() {
    const std::lock_guard lock(impl_->mutex);
    impl_->paused = true;
    impl_->analysis_cancel.cancel();
    impl_->changed();
}

void Preview::resume() {
    const std::lock_guard lock(impl_->mutex);
    impl_->paused = false;
    impl_->analysis_news = impl_->to_analyse != nullptr;
    impl_->changed();
    impl_->signal();
}

bool Preview::try_read(int frame, RegionId region, PreviewReading& reading) const {
    PreviewReading old;  // freed after the lock is
    const std::unique_lock lock(impl_->mutex, std::try_to_lock);
    if (!lock) return false;
    std::swap(old, reading);
    reading.view = impl_->shown;
    reading.paused = impl_->paused;
    reading.overlay = impl_->overlay;
    if (const auto found = impl_->confidences.find(region); found != impl_->confidences.end())
        reading.confidence = found->second;
    if (!impl_->opened || impl_->opened->pixels != impl_->wanted_pixels) return true;
    for (const auto& [number, pictures] : impl_->frames)
        reading.there.push_back(number);
    if (const auto found = impl_->frames.find(frame); found != impl_->frames.end())
        reading.frame = found->second;
    return true;
}

std::uint64_t Preview::news() const {
    return impl_->news.load();
}

Expected<Matte> Preview::propagated_matte(RegionId region, int frame) const {
    OpenedPtr now;
    {
        const std::lock_guard lock(impl_->mutex);
        now = impl_->opened;
    }
    if (now) {
        for (std::size_t k = 0; k < now->shot->region_index.size(); ++k) {
            if (now->shot->project.regions[now->shot->region_index[k]]->id != region) continue;
            const AnalysisKey key{static_cast<int>(k), frame, AnalysisKind::kMatte};
            if (!now->store->has(key)) break;
            WEFT_TRY(bytes, now->store->get(key));
            WEFT_TRY(stored, decode_matte(bytes));
            return std::move(stored.matte);
        }
    }
    return fail(ErrorCode::kMissingFrames,
                "The matte has not been propagated to frame " + std::to_string(frame) + " yet.");
}

std::uint64_t Preview::matte_version() const {
    return impl_->mattes.load();
}

}  // namespace weft
