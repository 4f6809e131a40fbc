#include "app/base/frames_on_disk.h"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "app/base/background.h"
#include "engine/media/sequence_pattern.h"

namespace weft {
namespace {

std::vector<int> list(const std::string& pattern) {
    const auto parsed = SequencePattern::parse(pattern);
    if (!parsed) return {};
    const auto found = parsed->list_frames();
    return found ? *found : std::vector<int>{};
}

}  // namespace

const std::vector<int>& FramesOnDisk::of(const std::string& pattern, double now_s) {
    constexpr double kAgain_s = 3;
    if (pending_.valid() && pending_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        frames_ = pending_.get();
    const bool other = pattern != pattern_;
    if (!pending_.valid() && (other || now_s - looked_at_s_ > kAgain_s)) {
        if (other) frames_.clear();
        pattern_ = pattern;
        looked_at_s_ = now_s;
        pending_ = in_background([pattern] { return list(pattern); });
    }
    static const std::vector<int> kNone;
    return pattern == pattern_ ? frames_ : kNone;
}

int count_existing(const std::vector<int>& frames, const std::vector<int>& on_disk) {
    std::vector<int> both;
    std::set_intersection(frames.begin(), frames.end(), on_disk.begin(), on_disk.end(),
                          std::back_inserter(both));
    return static_cast<int>(both.size());
}

}  // namespace weft
