#pragma once
#include <optional>

#include "engine/lighting/shading.h"

namespace weft {

/// What the estimate of a surface's light keeps from frame to frame: the shot's daylight, how far
/// the surface's colours go with it, and the surface's print. Frames come from the primary
/// reference to the end, then from it to the beginning. For one thread.
class SurfaceLight {
  public:
    /// `working`: the plate in linear light. `visible`: the region's matte without holdouts.
    [[nodiscard]] SurfaceSample measure(ViewF3 working, ViewU8x1 visible, ShadingOptions options,
                                        int frame, int primary);

  private:
    std::optional<Daylight> daylight_;  // of the first frame, with the evidence of the last
    DaylightEvidence at_primary_;
    std::optional<SurfacePrint> print_;  // of the first frame that shows the surface
    bool went_back_ = false;
};

}  // namespace weft
