#include "app/preview/plate_player.h"

#include <algorithm>
#include <utility>

#include "app/base/background.h"
#include "engine/color/color_space.h"

namespace weft {
namespace {

constexpr int kThreads = 2;

std::size_t picture_bytes(const PicturePtr& picture) {
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

bool PlatePlayer::try_want(const std::vector<int>& frames) {
    {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock) return false;
        if (frames == wanted_) return true;
        wanted_ = frames;
    }
    wake_.notify_all();
    return true;
}

bool PlatePlayer::try_read(int frame, Reading& reading) const {
    PicturePtr old;  // freed after the lock is
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return false;
    const auto found = pictures_.find(frame);
    const auto failed = errors_.find(frame);
    old = std::exchange(reading.picture, found == pictures_.end() ? nullptr : found->second);
    reading.error = failed == errors_.end() ? std::string() : failed->second;
    reading.frame = frame;
    reading.bytes = bytes_;
    const std::uint64_t now = changes_.load() + 1;
    if (reading.changes == now) return true;
    reading.changes = now;
    const std::vector<int>& all = reader_->frames();
    reading.states.assign(all.size(), State::kEmpty);
    const auto mark = [&](const auto& frames, State state) {
        for (const auto& [number, content] : frames)
            if (const auto at = std::lower_bound(all.begin(), all.end(), number); at != all.end())
                reading.states[static_cast<std::size_t>(at - all.begin())] = state;
    };
    mark(errors_, State::kFailed);
    mark(pictures_, State::kCached);
    return true;
}

bool PlatePlayer::next_frame(int& frame) {
    // Wants as many frames as fit, most urgent first.
    std::size_t room = budget_bytes_;
    for (const int candidate : wanted_) {
        if (errors_.contains(candidate)) continue;
        const auto found = pictures_.find(candidate);
        if (found != pictures_.end()) {
            if (picture_bytes(found->second) > room) return false;
            room -= picture_bytes(found->second);
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

std::vector<PicturePtr> PlatePlayer::make_room(std::size_t bytes) {
    std::vector<PicturePtr> gone;
    if (pictures_.empty() || bytes_ + bytes <= budget_bytes_) return gone;
    // Frees unwanted frames first, then the least urgent.
    std::map<int, std::size_t> urgency;
    for (std::size_t k = 0; k < wanted_.size(); ++k)
        urgency.emplace(wanted_[k], k);
    std::vector<std::pair<std::size_t, int>> order;
    for (const auto& [frame, picture] : pictures_) {
        const auto found = urgency.find(frame);
        order.emplace_back(found == urgency.end() ? wanted_.size() : found->second, frame);
    }
    std::sort(order.begin(), order.end());
    for (; !order.empty() && bytes_ + bytes > budget_bytes_; order.pop_back()) {
        const auto worst = pictures_.find(order.back().second);
        bytes_ -= picture_bytes(worst->second);
        gone.push_back(std::move(worst->second));
        pictures_.erase(worst);
    }
    return gone;
}

void PlatePlayer::keep(int frame, Expected<PlateFrame> decoded) {
    PicturePtr picture;
    if (decoded) {
        const bool eight_bit = decoded->depth == PixelDepth::kU8 && reader_->display_encoded();
        picture = make_picture(decoded->rgb, eight_bit, srgb_.get(), linear_.get());
    }
    std::vector<PicturePtr> gone;  // freed after the lock is: pictures are large
    const std::lock_guard lock(mutex_);
    std::erase(decoding_, frame);
    ++changes_;
    if (!picture) {
        errors_[frame] = decoded.error().text();
        return;
    }
    gone = make_room(picture_bytes(picture));
    bytes_ += picture_bytes(picture);
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
