#pragma once
#include <vector>

#include "engine/core/error.h"
#include "engine/motion/corner_track.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Makes a planar track of a surface's motion: on every frame the homography that fits the motion
/// of some places best, as the corners of an upright box around them. Not thread-safe.
class PlanarTracker {
  public:
    /// Places on one frame, plate pixels.
    explicit PlanarTracker(std::vector<Vec2> places);
    /// `there_from_here`: the motion from the frame of the places to `frame`. What moves otherwise
    /// than most is left out (fit_plane()). Errors: Usage (too few places),
    /// RenderFailed (the motion is not that of a plane).
    [[nodiscard]] Status add(int frame, const LatticeField& there_from_here);
    [[nodiscard]] const CornerTrack& track() const { return track_; }

  private:
    std::vector<Vec2> places_;
    Quad<double> box_{};
    CornerTrack track_;
};

}  // namespace weft
