#pragma once
// Detects scene cuts in a plate.

#include <array>
#include <map>
#include <mutex>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// Examines frames as they are read, in any order, and compares neighbours. Thread-safe.
class CutWatch {
  public:
    void look_at(int frame, ViewF3 plate, bool display_encoded);
    /// The first frames of new scenes, ascending. At a cut, both the spatial distribution and the
    /// histogram of luma change far more than within a scene; a flash or a fast pan changes only
    /// one of them.
    [[nodiscard]] std::vector<int> cuts() const;

  private:
    static constexpr int kColumns = 16, kRows = 9, kBins = 32;
    struct Look {
        std::array<float, kColumns * kRows> means{};  // mean luma of each cell, display-encoded
        std::array<float, kBins> shares{};            // histogram of luma
    };
    mutable std::mutex mutex_;
    std::map<int, Look> looks_;
};

}  // namespace weft
