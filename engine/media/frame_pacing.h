#pragma once
// Internal: detects whether a movie's frame rate is constant.

#include <cstdint>
#include <vector>

namespace weft {

/// Collects the time stamps of a movie's frames in the order in which they are shown.
class FramePacing {
  public:
    void add(std::int64_t stamp) { stamps_.push_back(stamp); }
    /// A frame without a time stamp: nothing is known from here on.
    void add_unknown() { known_ = false; }

    /// The display times of single frames, in ticks. The last frame's is unknown.
    struct Durations {
        std::int64_t shortest = 0, longest = 0;
    };
    [[nodiscard]] Durations durations() const;
    /// True if some frame is shown for clearly longer or shorter than most. Containers round time
    /// stamps to whole ticks, so a constant rate gives durations that differ by a tick or two.
    [[nodiscard]] bool varies() const;

  private:
    std::vector<std::int64_t> stamps_;
    bool known_ = true;
};

}  // namespace weft
