#pragma once
// Notices where a plate changes to another scene.

#include <array>
#include <map>
#include <mutex>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// Looks at frames as they are read, in any order, and compares neighbours. Thread-safe.
class CutWatch {
  public:
    void look_at(int frame, ViewF3 plate, bool display_encoded);
    /// The first frames of new scenes, ascending: their picture differs from the frame before far
    /// more than pictures of one scene do, in where light and dark are and in how much there is of
    /// each. A flash or a fast pan differs in one of the two only.
    [[nodiscard]] std::vector<int> cuts() const;

  private:
    static constexpr int kColumns = 16, kRows = 9, kBins = 32;
    struct Look {
        std::array<float, kColumns * kRows> means{};  // of luma, display-encoded
        std::array<float, kBins> shares{};            // histogram of luma
    };
    mutable std::mutex mutex_;
    std::map<int, Look> looks_;
};

}  // namespace weft
