#include "app/preview/playback.h"

#include <algorithm>
#include <utility>

namespace weft {

void Playback::open(std::vector<int> frames) {
    frames_ = std::move(frames);
    if (std::exchange(begins_, false) ||
        !std::binary_search(frames_.begin(), frames_.end(), frame_))
        frame_ = frames_.front();
}

void Playback::close() {
    frames_.clear();
}

void Playback::reset() {
    begins_ = true;
    direction_ = 0;
    mark_in_.reset();
    mark_out_.reset();
}

int Playback::index_of(int frame) const {
    if (frames_.empty()) return 0;
    const auto at = std::lower_bound(frames_.begin(), frames_.end(), frame);
    return static_cast<int>(std::min<std::ptrdiff_t>(
        at - frames_.begin(), static_cast<std::ptrdiff_t>(frames_.size()) - 1));
}

std::pair<int, int> Playback::range() const {
    if (frames_.empty()) return {0, 0};
    int first = 0, last = static_cast<int>(frames_.size()) - 1;
    if (mark_in_) first = std::clamp(index_of(*mark_in_), first, last);
    if (mark_out_) last = std::clamp(index_of(*mark_out_), first, last);
    return {first, last};
}

void Playback::mark(std::optional<int> in, std::optional<int> out) {
    if (in && out && *in > *out) std::swap(in, out);
    mark_in_ = in;
    mark_out_ = out;
}

bool Playback::go_to(int frame) {
    if (frames_.empty()) return false;
    const int to = frames_[static_cast<std::size_t>(index_of(frame))];
    return std::exchange(frame_, to) != to;
}

bool Playback::step(int count) {
    if (frames_.empty()) return false;
    const int last = static_cast<int>(frames_.size()) - 1;
    return go_to(frames_[static_cast<std::size_t>(std::clamp(index() + count, 0, last))]);
}

void Playback::play(int direction) {
    direction_ = frames_.size() > 1 ? direction : 0;
    frame_at_s_ = fps_since_s_ = now_s_;
    shown_ = 0;
    // What has been played to its end begins again.
    const auto [first, last] = range();
    if (mode_ == PlayMode::kOnce && direction_ != 0 && index() == (direction_ > 0 ? last : first))
        go_to(frames_[static_cast<std::size_t>(direction_ > 0 ? first : last)]);
}

void Playback::advance(double now_s, double fps, const std::vector<PlatePlayer::State>& decoded) {
    now_s_ = now_s;
    if (direction_ == 0 || frames_.empty()) return;
    const auto [first, last] = range();
    constexpr int kMostAtOnce = 4;
    for (int k = 0; k < kMostAtOnce && now_s - frame_at_s_ >= 1.0 / fps; ++k) {
        int next = index() + direction_;
        if (next > last || next < first) {
            if (mode_ == PlayMode::kOnce) return stop();
            if (mode_ == PlayMode::kPingPong) direction_ = -direction_;
            next = mode_ == PlayMode::kPingPong ? std::clamp(index() + direction_, first, last)
                   : direction_ > 0             ? first
                                                : last;
        }
        const auto at = static_cast<std::size_t>(next);
        // On the first loop, waits for frames that are not decoded yet; later loops run in real
        // time.
        if (at >= decoded.size() || decoded[at] == PlatePlayer::State::kEmpty) {
            frame_at_s_ = now_s;
            break;
        }
        frame_ = frames_[at];
        frame_at_s_ += 1.0 / fps;
        ++shown_;
    }
    constexpr double kLate_s = 0.5, kMeasured_s = 0.5;
    if (now_s - frame_at_s_ > kLate_s) frame_at_s_ = now_s;
    if (now_s - fps_since_s_ > kMeasured_s) {
        shown_fps_ = shown_ / (now_s - fps_since_s_);
        fps_since_s_ = now_s;
        shown_ = 0;
    }
}

std::vector<int> Playback::upcoming() const {
    if (frames_.empty()) return {};
    constexpr int kMost = 2000;
    const auto [first, last] = range();
    std::vector<int> out{frame_};
    int next = index();
    for (int k = 1; k < std::min(last - first + 1, kMost); ++k) {
        next += direction_ < 0 ? -1 : 1;
        if (next > last) next = first;
        if (next < first) next = last;
        out.push_back(frames_[static_cast<std::size_t>(next)]);
    }
    return out;
}

}  // namespace weft
