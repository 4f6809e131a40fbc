#pragma once
// Which of two motions each pixel has followed so far: the surface's or that of what surrounds it.

#include "engine/core/fields.h"
#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

/// 1: moves as the surface does, −1: as what is around it; less where both move nearly alike.
/// Motions in pixels; `unit_px`: a pixel of 854×480.
[[nodiscard]] float side_of(Vec2 motion, Vec2 surface, Vec2 around, float unit_px);

/// Input of MotionSides::advance(). `outside_motion` (of the area's size) is the motion of what
/// surrounds the surface, extended inwards; the others are of the frame's size.
struct SidesInput {
    ViewF1 prev_phi;  ///< Signed distance of the matte's boundary in the frame before, pixels.
    const FlowField& flow;  ///< prev_from_cur as measured.
    ViewF2 outside_motion;  ///< prev_from_cur.
    Recti area;             ///< Where it lies in the frame.
    float unit_px;          ///< A pixel of 854×480.
};

/// Evidence that adds up from frame to frame. A strip of the background that a loosely painted
/// outline takes in looks like the surface in every single frame, but keeps moving with the
/// background. Only where the surface moves as one stiff piece (most of it within the motion of one
/// plane) and its surroundings move otherwise does motion tell the sides apart; elsewhere nothing
/// is added. (Cf. the layers of Wang & Adelson 1994.) Not thread-safe.
class MotionSides {
  public:
    /// Goes on by a frame. Log odds for inside over the area, −kMost to kMost, 0 where nothing is
    /// known. Parallel over rows; deterministic.
    ImageF1 advance(const SidesInput& input);

    /// Nothing has been followed at the pixels of the last frame that are not 0 here.
    void forget(ViewU8x1 where);

    static constexpr float kMost = 4;

  private:
    [[nodiscard]] float last(float x, float y) const;

    ImageF1 odds_;  ///< Of the last frame …
    Recti area_;    ///< … over this part of it.
};

/// Adds what MotionSides::advance() says to the log odds near the boundary, and deeper inside,
/// where it clearly says outside, to what reopens a decided part (`wide`). `phi`: the expected
/// signed distance, px. All of one size.
void add_sides(const ImageF1& sides, const ImageF1& phi, ImageF1& near, ImageF1& wide);

}  // namespace weft
