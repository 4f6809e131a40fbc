#pragma once
// Internal: whether a movie's frames follow each other at a constant rate.

#include <cstdint>
#include <vector>

namespace weft {

/// Collects the time stamps of a movie's frames in the order in which they are shown.
class FramePacing {
  public:
    void add(std::int64_t stamp) { stamps_.push_back(stamp); }
    /// A frame without a time stamp: nothing is known from here on.
    void add_unknown() { known_ = false; }

    /// For how long single frames are shown, in ticks. The last frame's duration is not known.
    struct Durations {
        std::int64_t shortest = 0, longest = 0;
    };
    [[nodiscard]] Durations durations() const;
    /// True when some frame is shown for clearly longer or shorter than most are. Containers round
    /// time stamps to whole ticks, so a constant rate gives durations that differ by a tick or two.
    [[nodiscard]] bool varies() const;

  private:
    std::vector<std::int64_t> stamps_;
    bool known_ = true;
};

}  // namespace weft
