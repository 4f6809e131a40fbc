#pragma once
// Islands of a matte that are none of it: they stayed behind, or were never part of it.

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/mask/surface_palette.h"

namespace weft {

/// All of the frame's size. Motion leads to the frame before, pixels.
struct IslandInput {
    ViewU8x3 frame;        ///< Display codes.
    ViewF1 phi;            ///< Signed distance of the boundary that was found, px, inside positive.
    ViewF1 prev_phi;       ///< Of the frame before.
    const Matte& entered;  ///< Newcomers::entered() of the frame.
    const FlowField& flow;
    ViewF2 background_motion;  ///< Of what is outside, carried on inside.
    ViewU8x3 key_frame;
    ViewF1 key_phi;
    const SurfacePalette& palette;
    ViewF2 key_from_cur;  ///< Where each pixel's surface lay on the keyframe, px.
    float unit_px;        ///< A pixel of 854×480.
};

/// What a moving surface uncovers can have its colours, and is then taken for it. When the surface
/// has moved on, that is an island, and moves as the background does, while the surface does not.
/// An island that did so for three frames and does not look like the place of the surface that it
/// is taken for is none of it. Where most of the surface moves as the background does nothing is
/// said of these. What is an island from the first, on what was clearly outside and went on as it
/// was, has only got the surface's colours, as when a shade leaves it. One that was never part of
/// the surface, but came into view beside it and has its colours, is another thing of the same
/// kind, unless as much of the surface is missing. Not thread-safe.
class LeftBehind {
  public:
    /// Goes on by a frame. Not 0: such an island. Empty if there is none.
    /// Deterministic.
    [[nodiscard]] Matte advance(const IslandInput& in);

  private:
    ImageF1 frames_;  ///< For how many frames the island at a pixel of the last frame has stayed.
};

}  // namespace weft
