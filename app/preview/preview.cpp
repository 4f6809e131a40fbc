#include "app/preview/preview.h"

#include "app/preview/preview_impl.h"

namespace weft {
namespace {

// Delay without a new request before rendering at full size.
constexpr std::chrono::milliseconds kPause{350};

}  // namespace

Preview::Preview(AnalysisCacheOptions cache, std::string texture_library, std::size_t budget_bytes)
    : impl_(std::make_unique<Impl>(std::move(cache), std::move(texture_library), budget_bytes)) {}
Preview::~Preview() = default;

bool Preview::try_request(const PreviewRequest& request) {
    std::string pixels = pixel_key(request.project) + std::to_string(request.files);
    std::string analysis = analysis_key(request.project);
    std::optional<PreviewRequest> next = request;  // the one before is freed after the lock is
    const auto shared = impl_->guarded.try_lock();
    if (!shared) return false;
    if (!shared->wanted || shared->wanted_pixels != pixels ||
        shared->wanted->frame != request.frame) {
        shared->requested_at = Impl::Clock::now();
        shared->first_shown = false;
    }
    if (shared->wanted_pixels != pixels) {
        shared->failed_pixels.clear();
        shared->grow_cancel.cancel();
    }
    if (!shared->wanted || shared->wanted->frame != request.frame ||
        shared->wanted_analysis != analysis)
        shared->draft_cancel.cancel();
    shared->card_cancel.cancel();
    if (!shared->analysing_key.empty() && shared->analysing_key != analysis)
        shared->analysis_cancel.cancel();
    shared->wanted.swap(next);
    shared->wanted_pixels = std::move(pixels);
    shared->wanted_analysis = std::move(analysis);
    shared->refine_at = Impl::Clock::now() + kPause;
    impl_->signal(*shared);
    return true;
}

void Preview::propagate(const Project& project, const PaintedMattes& painted, int frame) {
    impl_->propagator.propagate(project, painted, frame);
}

void Preview::clear() {
    std::map<int, PreviewFrame> old;  // freed after the lock is: pictures are large
    std::map<std::string, StripCard> old_cards;
    const auto shared = impl_->guarded.lock();
    shared->wanted.reset();
    shared->wanted_pixels.clear();
    shared->wanted_analysis.clear();
    shared->failed_pixels.clear();
    shared->analysis_cancel.cancel();
    shared->grow_cancel.cancel();
    shared->draft_cancel.cancel();
    shared->card_cancel.cancel();
    old.swap(shared->frames);
    old_cards.swap(shared->cards);
    shared->frame_bytes = 0;
    shared->provisional.reset();
    shared->overlay.reset();
    shared->confidences.clear();
    shared->healths.clear();
    shared->shown = {};
    impl_->changed(*shared);
}

void Preview::forget(std::uint64_t document) {
    clear();
    impl_->propagator.clear();
    impl_->guarded.lock()->document = document;
}

void Preview::pause() {
    impl_->propagator.pause();
    const auto shared = impl_->guarded.lock();
    shared->paused = true;
    shared->analysis_cancel.cancel();
    impl_->changed(*shared);
}

void Preview::resume() {
    impl_->propagator.resume();
    const auto shared = impl_->guarded.lock();
    shared->paused = false;
    shared->analysis_pending = shared->to_analyse != nullptr;
    impl_->changed(*shared);
    impl_->signal(*shared);
}

void Preview::set_render_paused(bool paused) {
    impl_->render_paused = paused;
}

bool Preview::try_read(int frame, RegionId region, int layer, PreviewReading& reading) const {
    PreviewReading old;  // freed after the lock is
    const auto shared = impl_->guarded.try_lock();
    if (!shared) return false;
    std::swap(old, reading);
    reading.view = shared->shown;
    reading.paused = shared->paused;
    reading.overlay = shared->overlay;
    reading.cards = shared->cards;
    if (!shared->opened || shared->opened->document != shared->document) return true;
    if (const auto found = shared->confidences.find({region, layer});
        found != shared->confidences.end())
        reading.confidence = found->second;
    if (const auto found = shared->healths.find(region); found != shared->healths.end())
        reading.health = found->second;
    if (shared->opened->pixels != shared->wanted_pixels) return true;
    for (const auto& [number, pictures] : shared->frames)
        reading.rendered.push_back(number);
    if (const auto found = shared->frames.find(frame); found != shared->frames.end())
        reading.frame = found->second;
    else if (shared->provisional && shared->provisional_frame == frame)
        reading.frame = *shared->provisional;
    return true;
}

std::uint64_t Preview::changes() const {
    return impl_->changes.load() + impl_->propagator.changes();
}

Expected<Matte> Preview::propagated_matte(const WantedMatte& wanted) const {
    if (const auto [now, k] = impl_->find_opened(wanted.region); now)
        if (auto found = matte_in(now->asked, *now->shot, *now->store, wanted)) return found;
    return impl_->propagator.matte(wanted);
}

std::vector<int> Preview::reached(const WantedMatte& wanted) const {
    if (const auto [now, k] = impl_->find_opened(wanted.region); now)
        if (auto found = reached_in(now->asked, *now->shot, *now->store, wanted); !found.empty())
            return found;
    return impl_->propagator.reached(wanted);
}

Expected<LatticeField> Preview::track(RegionId region, int before, int now) const {
    if (const auto [opened, k] = impl_->find_opened(region); opened)
        return track_between(*opened, k, before, now);
    return fail(ErrorCode::kMissingFrames,
                "Frame " + std::to_string(now) + " has not been analysed yet.");
}

std::pair<OpenedPtr, std::size_t> Preview::Impl::find_opened(RegionId region) const {
    OpenedPtr now;
    {
        const auto shared = guarded.lock();
        if (shared->opened && shared->opened->document == shared->document) now = shared->opened;
    }
    for (std::size_t k = 0; now && k < now->shot->region_index.size(); ++k)
        if (now->shot->project.regions[now->shot->region_index[k]]->id == region) return {now, k};
    return {nullptr, 0};
}

std::uint64_t Preview::matte_version() const {
    return impl_->mattes.load() + impl_->propagator.changes();
}

}  // namespace weft
