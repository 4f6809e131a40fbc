#include "app/session/preview.h"

#include "app/session/preview_impl.h"

namespace weft {
namespace {

// A moment without a new wish is time enough for full size.
constexpr std::chrono::milliseconds kPause{350};

}  // namespace

Preview::Preview(AnalysisCacheOptions cache, std::string texture_library, std::size_t budget_bytes)
    : impl_(std::make_unique<Impl>(std::move(cache), std::move(texture_library), budget_bytes)) {}
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
    impl_->card_cancel.cancel();
    if (!impl_->analysing_key.empty() && impl_->analysing_key != analysis)
        impl_->analysis_cancel.cancel();
    impl_->wanted.swap(next);
    impl_->wanted_pixels = std::move(pixels);
    impl_->wanted_analysis = std::move(analysis);
    impl_->refine_at = Impl::Clock::now() + kPause;
    impl_->signal();
    return true;
}

void Preview::clear() {
    std::map<int, PreviewFrame> old;  // freed after the lock is: pictures are large
    std::map<std::string, StripCard> old_cards;
    const std::lock_guard lock(impl_->mutex);
    impl_->wanted.reset();
    impl_->wanted_pixels.clear();
    impl_->wanted_analysis.clear();
    impl_->failed_pixels.clear();
    impl_->analysis_cancel.cancel();
    impl_->grow_cancel.cancel();
    impl_->card_cancel.cancel();
    old.swap(impl_->frames);
    old_cards.swap(impl_->cards);
    impl_->frame_bytes = 0;
    impl_->overlay.reset();
    impl_->confidences.clear();
    impl_->healths.clear();
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

bool Preview::try_read(int frame, RegionId region, int layer, PreviewReading& reading) const {
    PreviewReading old;  // freed after the lock is
    const std::unique_lock lock(impl_->mutex, std::try_to_lock);
    if (!lock) return false;
    std::swap(old, reading);
    reading.view = impl_->shown;
    reading.paused = impl_->paused;
    reading.overlay = impl_->overlay;
    reading.cards = impl_->cards;
    if (const auto found = impl_->confidences.find({region, layer});
        found != impl_->confidences.end())
        reading.confidence = found->second;
    if (const auto found = impl_->healths.find(region); found != impl_->healths.end())
        reading.health = found->second;
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

Expected<Matte> Preview::propagated_matte(RegionId region, int layer, int frame) const {
    if (const auto [now, k] = impl_->find_opened(region); now) {
        const int kept =
            stored_layer(*now->shot->project.regions[now->shot->region_index[k]], layer);
        const AnalysisKey key{static_cast<int>(k), frame, AnalysisKind::kMatte, kept};
        if (kept >= 0 && now->store->has(key)) {
            WEFT_TRY(bytes, now->store->get(key));
            WEFT_TRY(stored, decode_matte(bytes));
            return std::move(stored.matte);
        }
    }
    return fail(ErrorCode::kMissingFrames,
                "The matte has not been propagated to frame " + std::to_string(frame) + " yet.");
}

Expected<LatticeField> Preview::carried(RegionId region, int before, int now) const {
    if (const auto [opened, k] = impl_->find_opened(region); opened)
        return carried_between(*opened, k, before, now);
    return fail(ErrorCode::kMissingFrames,
                "Frame " + std::to_string(now) + " has not been analysed yet.");
}

std::pair<OpenedPtr, std::size_t> Preview::Impl::find_opened(RegionId region) const {
    OpenedPtr now;
    {
        const std::lock_guard lock(mutex);
        now = opened;
    }
    for (std::size_t k = 0; now && k < now->shot->region_index.size(); ++k)
        if (now->shot->project.regions[now->shot->region_index[k]]->id == region) return {now, k};
    return {nullptr, 0};
}

std::uint64_t Preview::matte_version() const {
    return impl_->mattes.load();
}

}  // namespace weft
