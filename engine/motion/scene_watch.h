#pragma once
// Whether frames still show the scene that a walk began in. Cuts between scenes that look alike,
// and dissolves, change neither the picture's composition nor its histogram at once.

#include <deque>
#include <memory>

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// A frame for SceneWatch: small, so that many can be kept.
struct SceneFrame {
    Matte luma;
    FlowField prev_from_cur;  ///< Empty on the first frame of a walk.
};
/// `luma`: display-encoded. `prev_from_cur` of its size, or empty. At most 240×135 px are kept.
[[nodiscard]] SceneFrame scene_frame(ViewU8x1 luma, const FlowField& prev_from_cur);

/// Follows a walk from its first frame. The frame before, and that of up to 12 frames before, are
/// warped along the motion onto each frame and compared with it cell by cell, by the correlation of
/// what they show, which exposure and fades do not change. After a cut the motion explains nearly
/// no cell of the frame before; after a dissolve each step could be explained, but no cell shows
/// what it did twelve frames ago. Fast motion loses cells from step to step, so a frame is only
/// taken for dissolved if the steps before it lost few. Not thread-safe.
class SceneWatch {
  public:
    /// The next frame. Returns false once the scene is another one; it stays so.
    [[nodiscard]] bool still_shows(std::shared_ptr<const SceneFrame> frame);

  private:
    struct Kept {
        std::shared_ptr<const SceneFrame> frame;
        float found = 1;  ///< Share of the cells that the frame before explains.
    };
    [[nodiscard]] bool is_dissolved() const;

    std::deque<Kept> kept_;  // latest last
    bool other_ = false;
};

}  // namespace weft
