#pragma once
// Sheen or soft paint: what a surface that turns tells.

#include <array>
#include <vector>

#include "engine/core/image.h"
#include "engine/lighting/surface_sample.h"

namespace weft {

/// How a frame's surface lies on the reference frame: the linear part of the displacements' best
/// affine map, row by row. The identity for an empty sample.
using SurfaceLie = std::array<float, 4>;

/// `ref_from_cur`: displacements over the sample's box, small pixels.
[[nodiscard]] SurfaceLie surface_lie(const SurfaceSample& sample, const ImageF2& ref_from_cur);

/// By how much a surface has turned within the clip, at most: sin² of the angle, about the line of
/// sight, or away from it, which shows as a squeeze. A zoom and a slide are no turn.
[[nodiscard]] float most_turned(const std::vector<SurfaceLie>& lies);

/// How a surface's colours change while it turns. All sums are over the places of all frames.
class ColourChange {
  public:
    /// `usual`: what is usual at each place over time; `now`: of one frame, at the same places;
    /// `known`: above 0 where both count. All H×W.
    void add(const ImageF1& usual, const ImageF1& now, const ImageF1& known);
    /// The part of the usual variation that is another one in each frame, 0 and more.
    [[nodiscard]] float share() const { return all_ > 0 ? static_cast<float>(change_ / all_) : 0; }

  private:
    double all_ = 0, change_ = 0;
};

/// 0 to 1: how surely a variation is painted on, because the surface has turned by `turn` (sin²)
/// and it has not changed. What depends on direction changes by that share, about.
[[nodiscard]] float painted_on(float turn, float changed_share);

}  // namespace weft
