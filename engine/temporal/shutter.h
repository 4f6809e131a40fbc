#pragma once
// The plate's shutter angle, measured from its motion blur.

#include <vector>

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Measures the shutter of a plate from a moving surface. The variogram of a picture (how much
/// pixels τ px apart differ) is taken along the motion and across it. A shutter that is open while
/// the surface moves by L px averages along the motion only. The blur is the L that turns the
/// variogram across into the one along, if it explains that clearly better than no blur. Not
/// thread-safe.
class ShutterMeter {
  public:
    /// `luma`: a frame, 8 bit; `visible`: the region's matte without holdouts; `prev_from_cur`: the
    /// surface's motion to the frame before, pixels. Ignored unless enough of the surface (400
    /// places of a 2 px grid) moves by at least 4 px.
    void add(ViewU8x1 luma, ViewU8x1 visible, const LatticeField& prev_from_cur);
    /// The shutter angle in degrees of 360 per frame, the median over the frames. 0 if nothing
    /// moved fast enough, or the frames do not clearly show a blur.
    [[nodiscard]] float degrees() const;

  private:
    std::vector<float> open_;  // share of each frame; 0: sharp
};

}  // namespace weft
