#pragma once
// Holds: in drawn animation a drawing often stays for two or three frames.

#include <optional>

#include "engine/core/image.h"

namespace weft {

/// Limits of the difference between two frames of one drawing, in 8-bit levels of the channel that
/// differs most. A codec leaves small differences; a line that moves by half a pixel differs by
/// about ten in the blocks that it crosses.
struct HoldLimits {
    float mean = 0.5f;   ///< Of the difference over the whole surface.
    float block = 2.0f;  ///< Of every block of 8×8 px of the frame, over its part of the surface.
};

/// What a frame shows of a region.
struct HoldView {
    ViewU8x3 display;  ///< The region's full matte.
    ViewU8x1 extent;   ///< The holdout; may be empty.
    ViewU8x1 holdout;  ///< What passes in front of it; may be empty.
};

/// True if two frames show the same drawing of a region. Compares the pixels where either full
/// matte is at least a half and neither holdout is above 0, so a flat fill that moves differs at
/// its outline, and background and holdouts do not count. False if fewer than 64 such pixels are
/// left, or less than a third of the full mattes. All H×W. Thread-safe.
[[nodiscard]] bool same_drawing(const HoldView& a, const HoldView& b,
                                const HoldLimits& limits = {});

/// Detects frame by frame whether a region's drawing is held. Each frame is compared with the first
/// one of the hold, of which a copy is kept, so that slow movement does not pass for a hold. Not
/// thread-safe.
class HeldFrames {
  public:
    explicit HeldFrames(const HoldLimits& limits = {}) : limits_(limits) {}
    /// The next frame of the walk, in either direction of time. True if it shows the drawing of the
    /// frame before; the coordinates of that frame then hold for it bit for bit.
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
