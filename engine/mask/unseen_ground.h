#pragma once
// What lies beside a surface and was not seen there on the keyframe.

#include <cstdint>

#include "engine/core/fields.h"
#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/mask/surface_palette.h"

namespace weft {

/// A step of the walk. Views have the frame's size but `surface_motion`, which has that of `area`.
struct GroundStep {
    ViewU8x3 frame, prev_frame;  ///< Display codes.
    const FlowField& flow;       ///< prev_from_cur as measured.
    const Matte& parting;        ///< parting_pixels() of it and the whole frame.
    ViewF2 surface_motion;       ///< prev_from_cur of the surface, px.
    Recti area;                  ///< Where the surface may be; empty once it has left the frame.
    ViewF1 prev_phi, phi;  ///< Signed distance of the matte on the frame before and on this one.
    float unit_px = 1;     ///< A pixel of a frame 854 wide.
};

/// Of all that is outside it is known whether it was seen outside on the keyframe and ever since.
/// What was not (it came out from behind something, or was inside once) and for some frames has
/// the surface's colours, goes with its motion, and is joined to it by more of its outline than to
/// what is known to be outside, is the surface: a sheet where somebody has jumped on it, a shirt
/// behind a kettle. A frame on which most of what was seen outside is lost tells nothing. Not
/// thread-safe.
class UnseenGround {
  public:
    /// `key_phi`: signed distance of the keyframe's matte, px; 0 where it is not seen.
    explicit UnseenGround(ViewF1 key_phi);

    /// Goes on by a frame. 255 where the surface is to be added; empty: nowhere. Parallel over
    /// rows; deterministic.
    [[nodiscard]] Matte advance(const GroundStep& step, const SurfacePalette& palette);

  private:
    void follow(const GroundStep& step, const SurfacePalette& palette);

    Matte known_;   // 255: was outside on the keyframe, and has been since
    Matte waited_;  // frames for which something has looked like the surface
};

}  // namespace weft
