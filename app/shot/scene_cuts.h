#pragma once
// Detects scene cuts in a plate.

#include <map>
#include <mutex>
#include <vector>

#include "engine/core/image.h"
#include "engine/pipeline/frame_look.h"

namespace weft {

/// Examines frames as they are read, in any order, and compares neighbours. Thread-safe.
class CutWatch {
  public:
    void look_at(int frame, ViewF3 plate, bool display_encoded);
    /// The first frames of new scenes, ascending (may_be_cut()). Frames that show nothing are none:
    /// what follows them is compared with what was before. Nor are up to three frames after which
    /// the scene comes back, such as a flash.
    [[nodiscard]] std::vector<int> cuts() const;

  private:
    mutable std::mutex mutex_;
    std::map<int, FrameLook> looks_;
};

}  // namespace weft
