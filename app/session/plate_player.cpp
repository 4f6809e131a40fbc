#include "app/session/plate_player.h"

#include <algorithm>

#include "app/session/background.h"
#include "engine/color/color_space.h"

namespace weft {
namespace {

constexpr int kThreads = 2;

std::size_t bytes_of(const PicturePtr& picture) {
    return picture->size_bytes();
}

}  // namespace

PlatePlayer::PlatePlayer(std::shared_ptr<const FrameReader> reader,
                         std::shared_ptr<const ColorTransform> srgb,
                         std::shared_ptr<const ColorTransform> linear, std::size_t budget_bytes)
    : reader_(std::move(reader)),
      srgb_(std::move(srgb)),
      linear_(std::move(linear)),
      budget_bytes_(budget_bytes) {
    for (int k = 0; k < kThreads; ++k)
        threads_.emplace_back([this] { work(); });
}

PlatePlayer::~PlatePlayer() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_)
        thread.join();
}

void PlatePlayer::want(std::vector<int> frames) {
    {
        const std::lock_guard lock(mutex_);
        if (frames == wanted_) return;
        wanted_ = std::move(frames);
    }
    wake_.notify_all();
}

PicturePtr PlatePlayer::get(int frame) const {
    const std::lock_guard lock(mutex_);
    const auto found = pictures_.find(frame);
    return found == pictures_.end() ? nullptr : found->second;
}

PlatePlayer::State PlatePlayer::state(int frame) const {
    const std::lock_guard lock(mutex_);
    if (pictures_.contains(frame)) return State::kCached;
    return errors_.contains(frame) ? State::kFailed : State::kEmpty;
}

std::string PlatePlayer::error(int frame) const {
    const std::lock_guard lock(mutex_);
    const auto found = errors_.find(frame);
    return found == errors_.end() ? std::string() : found->second;
}

std::size_t PlatePlayer::size_bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
}

int PlatePlayer::cached_count() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(pictures_.size());
}

std::uint64_t PlatePlayer::arrivals() const {
    const std::lock_guard lock(mutex_);
    return arrivals_;
}

bool PlatePlayer::next_frame(int& frame) {
    // As many of the wanted frames as fit, the most urgent first.
    std::size_t room = budget_bytes_;
    for (const int candidate : wanted_) {
        if (errors_.contains(candidate)) continue;
        const auto found = pictures_.find(candidate);
        if (found != pictures_.end()) {
            if (bytes_of(found->second) > room) return false;
            room -= bytes_of(found->second);
            continue;
        }
        const std::size_t typical = pictures_.empty() ? 0 : bytes_ / pictures_.size();
        if (typical > room) return false;
        if (std::find(decoding_.begin(), decoding_.end(), candidate) != decoding_.end()) {
            room -= std::min(room, typical);
            continue;
        }
        frame = candidate;
        return true;
    }
    return false;
}

void PlatePlayer::make_room(std::size_t bytes) {
    // Unwanted frames go first, then the least urgent.
    const auto urgency = [&](int frame) {
        return static_cast<std::size_t>(std::find(wanted_.begin(), wanted_.end(), frame) -
                                        wanted_.begin());
    };
    while (!pictures_.empty() && bytes_ + bytes > budget_bytes_) {
        auto worst = pictures_.begin();
        for (auto it = pictures_.begin(); it != pictures_.end(); ++it) {
            if (urgency(it->first) > urgency(worst->first)) worst = it;
        }
        bytes_ -= bytes_of(worst->second);
        pictures_.erase(worst);
    }
}

void PlatePlayer::keep(int frame, Expected<PlateFrame> decoded) {
    PicturePtr picture;
    if (decoded) {
        const bool eight_bit = decoded->depth == PixelDepth::kU8 && reader_->display_encoded();
        picture = make_picture(decoded->rgb, eight_bit, srgb_.get(), linear_.get());
    }
    const std::lock_guard lock(mutex_);
    std::erase(decoding_, frame);
    ++arrivals_;
    if (!picture) {
        errors_[frame] = decoded.error().text();
        return;
    }
    make_room(bytes_of(picture));
    bytes_ += bytes_of(picture);
    pictures_[frame] = std::move(picture);
}

void PlatePlayer::work() {
    lower_thread_priority();
    for (;;) {
        int frame = 0;
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [&] { return stop_ || next_frame(frame); });
            if (stop_) return;
            decoding_.push_back(frame);
        }
        keep(frame, reader_->read(frame));
    }
}

}  // namespace weft
