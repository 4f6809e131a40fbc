#pragma once
// How long the plate's shutter is open: what its motion blur says of itself.

#include <vector>

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Measures the shutter of a plate from a moving surface. How much a picture differs over a way of
/// τ px, its variogram, is taken along the motion and across it. A shutter that is open while the
/// surface moves by L px averages along the motion alone; the L that turns the variogram across
/// into the one along is the blur, if it explains clearly more than none. Not thread-safe.
class ShutterMeter {
  public:
    /// `luma`: a frame, 8 bit; `visible`: the region's matte without holdouts; `prev_from_cur`: the
    /// surface's motion to the frame before. Frames in which it moves by less than 3 px say
    /// nothing.
    void add(ViewU8x1 luma, ViewU8x1 visible, const LatticeField& prev_from_cur);
    /// Degrees of 360 a frame, the median of the frames; 0 where nothing moved fast enough, or
    /// where the frames do not clearly show a blur.
    [[nodiscard]] float degrees() const;

  private:
    std::vector<float> open_;  // share of each frame; 0: sharp
};

}  // namespace weft
