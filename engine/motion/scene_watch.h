#pragma once
// Whether frames still show the scene that a walk began in. Cuts between scenes that look alike,
// and dissolves, change neither the picture's composition nor its histogram at once.

#include <array>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>

#include "engine/core/fields.h"
#include "engine/core/geometry.h"
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
/// what it did twelve frames ago, and a frame between was a mixture of both pictures. Fast motion
/// loses cells from step to step, too, but mixes nothing. Not thread-safe.
class SceneWatch {
  public:
    /// The next frame. Returns false once the scene is another one; it stays so.
    [[nodiscard]] bool still_shows(std::shared_ptr<const SceneFrame> frame);

  private:
    static constexpr std::size_t kFramesBack = 12;
    // Places on the frames kept, as those are ordered.
    using Path = std::array<Vec2, kFramesBack + 1>;
    [[nodiscard]] bool is_dissolved() const;
    // Where a pixel of the latest frame lies on each frame kept, by the motion between them; empty
    // if it has come from outside the picture.
    [[nodiscard]] std::optional<Path> path_back(int x, int y) const;
    // The largest share of cells that were, on a frame between, a mixture of first and latest.
    [[nodiscard]] float most_mixed() const;

    std::deque<std::shared_ptr<const SceneFrame>> kept_;  // latest last
    bool other_ = false;
};

}  // namespace weft
