#include "engine/pipeline/walk_memory.h"

#include "engine/motion/follow_size.h"

namespace weft {
namespace {

// Four 8-bit pictures and one of three channels, two of floats inside the surface, raw motion, some
// lattices.
std::size_t bytes_of(const WalkStep& step) {
    constexpr std::size_t kEachPixel = 24;
    const Size size = step.frame->size();
    return kEachPixel * static_cast<std::size_t>(size.width) *
           static_cast<std::size_t>(size.height);
}

// Its lattices, and those of its anchors. Frames are mostly those of steps that are kept; those of
// parts are not, nor are the pictures by which their mattes are carried.
std::size_t bytes_of(const SurfaceTrack& track) {
    constexpr std::size_t kLattices = 30, kEachPixelOfPart = 120;
    const Size size = follow_size(track.ref_from_cur().full_size());
    return kLattices * track.ref_from_cur().nodes().size_bytes() +
           kEachPixelOfPart * static_cast<std::size_t>(track.part_count()) *
               static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}

}  // namespace

std::optional<WalkStep> WalkMemory::find_step(const Hash128& key) {
    const std::lock_guard lock(mutex_);
    const Kept* kept = use(key);
    const Step* step = kept ? std::get_if<Step>(&kept->what) : nullptr;
    if (!step) return std::nullopt;
    return step->step;
}

void WalkMemory::keep_step(const Hash128& key, int frame, int previous, const WalkStep& step) {
    const std::lock_guard lock(mutex_);
    if (by_key_.contains(key)) return;
    frames_.insert({frame, previous});
    add({key, Step{step, {frame, previous}}, bytes_of(step)});
}

bool WalkMemory::expects(int frame, int previous) const {
    const std::lock_guard lock(mutex_);
    return frames_.contains({frame, previous});
}

std::shared_ptr<const SurfaceTrack> WalkMemory::find_track(const Hash128& key) {
    const std::lock_guard lock(mutex_);
    const Kept* kept = use(key);
    const auto* track =
        kept ? std::get_if<std::shared_ptr<const SurfaceTrack>>(&kept->what) : nullptr;
    return track ? *track : nullptr;
}

void WalkMemory::keep_track(const Hash128& key, std::shared_ptr<const SurfaceTrack> track) {
    const std::lock_guard lock(mutex_);
    if (by_key_.contains(key)) return;
    const std::size_t bytes = bytes_of(*track);
    add({key, std::move(track), bytes});
}

int WalkMemory::times_found() const {
    const std::lock_guard lock(mutex_);
    return times_found_;
}

const WalkMemory::Kept* WalkMemory::use(const Hash128& key) {
    const auto found = by_key_.find(key);
    if (found == by_key_.end()) return nullptr;
    kept_.splice(kept_.begin(), kept_, found->second);
    ++times_found_;
    return &*found->second;
}

void WalkMemory::add(Kept kept) {
    bytes_ += kept.bytes;
    kept_.push_front(std::move(kept));
    by_key_[kept_.front().key] = kept_.begin();
    while (bytes_ > most_bytes_)
        drop_oldest();
}

void WalkMemory::drop_oldest() {
    const Kept& oldest = kept_.back();
    bytes_ -= oldest.bytes;
    if (const Step* step = std::get_if<Step>(&oldest.what))
        frames_.erase(frames_.find(step->frames));
    by_key_.erase(oldest.key);
    kept_.pop_back();
}

}  // namespace weft
