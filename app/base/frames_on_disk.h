#pragma once
// Which frames of an output are on disk.

#include <future>
#include <string>
#include <vector>

namespace weft {

/// Looks them up in the background, again every few seconds. Belongs to one thread.
class FramesOnDisk {
  public:
    /// The frames of a pattern such as `out/####.png`, ascending; empty while they are not known,
    /// and where there are none or no folder. `now_s`: seconds of any clock that goes on.
    [[nodiscard]] const std::vector<int>& of(const std::string& pattern, double now_s);
    [[nodiscard]] bool busy() const { return pending_.valid(); }

  private:
    std::string pattern_;
    std::vector<int> frames_;
    double looked_at_s_ = 0;
    std::future<std::vector<int>> pending_;
};

/// How many of `frames` are among those `on_disk`; both ascend.
[[nodiscard]] int count_existing(const std::vector<int>& frames, const std::vector<int>& on_disk);

}  // namespace weft
