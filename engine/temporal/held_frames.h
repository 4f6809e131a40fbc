#pragma once
// Held drawings: in drawn animation a drawing often stands for two or three frames.

#include <optional>

#include "engine/core/image.h"

namespace weft {

/// How alike two frames of one drawing are, in 8-bit levels of the most differing channel. A codec
/// leaves a little; a line that moves by half a pixel differs by some ten in the blocks it crosses.
struct HoldLimits {
    float mean = 0.5f;   ///< Of the difference over the whole surface.
    float block = 2.0f;  ///< Of every block of 8×8 px of the frame, over its part of the surface.
};

/// What a frame shows of a region.
struct HoldView {
    ViewU8x3 display;  ///< The plate's display codes.
    ViewU8x1 extent;   ///< The region's matte, hidden parts included.
    ViewU8x1 holdout;  ///< What passes in front of it; may be empty.
};

/// Whether two frames show the same drawing of a region: compared are the pixels where either
/// extent is at least a half and neither holdout is above 0, so a flat fill that moves shows by its
/// outline, while background and whatever passes in front do not count. False where fewer than 64
/// such pixels are left, or less than a third of the extents. All of one size. Thread-safe.
[[nodiscard]] bool same_drawing(const HoldView& a, const HoldView& b,
                                const HoldLimits& limits = {});

/// Says frame by frame whether a region's drawing is held. Each frame is compared with the first
/// one of the hold, not with its neighbour, so that a slow movement does not pass for a hold. A
/// copy of that first frame is kept. Not thread-safe.
class HeldFrames {
  public:
    explicit HeldFrames(const HoldLimits& limits = {}) : limits_(limits) {}
    /// The next frame of the walk, in either direction of time: true where it shows the drawing of
    /// the frame before, whose coordinates then hold for it to the bit.
    [[nodiscard]] bool advance(const HoldView& frame);

  private:
    struct Kept {
        ImageU8x3 display;
        Matte extent, holdout;
    };
    HoldLimits limits_;
    std::optional<Kept> first_;
};

}  // namespace weft
