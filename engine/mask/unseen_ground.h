#pragma once
// What lies beside a surface and was not seen there on the keyframe.

#include <cstdint>

#include "engine/core/image.h"
#include "engine/mask/covered_surface.h"
#include "engine/mask/ground_step.h"
#include "engine/mask/surface_palette.h"

namespace weft {

/// Of all that is outside it is known whether it was seen outside on the keyframe and ever since.
/// What was not (it came out from behind something, or was inside once) and for some frames has
/// the surface's colours, goes with its motion, and is joined to it by more of its outline than to
/// what is known to be outside, is the surface: a sheet where somebody has jumped on it, a shirt
/// behind a kettle. What shows the surface where it was
/// behind something (CoveredSurface) has its colours. A frame on which most of what was seen
/// outside is lost tells nothing. Not thread-safe.
class UnseenGround {
  public:
    /// `key_phi`: signed distance of the keyframe's matte, px; 0 where it is not seen.
    UnseenGround(ViewU8x3 key_frame, ViewF1 key_phi);

    /// Goes on by a frame. 255 where the surface is to be added; empty: nowhere. Parallel over
    /// rows; deterministic.
    [[nodiscard]] Matte advance(const GroundStep& step, const SurfacePalette& palette);

    /// Of the pixels of the last frame where `wrong` is not 0 it is known now that they are inside
    /// where `inside` is not 0, and else outside.
    void correct(ViewU8x1 wrong, ViewU8x1 inside);

  private:
    void follow(const GroundStep& step, const SurfacePalette& palette);
    [[nodiscard]] Matte joined(const GroundStep& step, Matte ripe, ViewU8x1 own) const;

    Matte known_;  // 255: was outside on the keyframe, and has been since
    CoveredSurface covered_;
    ImageF1 own_;   // covered_'s log odds on the last frame
    Matte waited_;  // frames for which something has looked like the surface
};

}  // namespace weft
