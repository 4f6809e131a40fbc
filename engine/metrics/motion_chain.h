#pragma once
// Motion from one frame to a distant one, chained from the motion between neighbours.

#include <vector>

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// Tracks the surface points that the pixels of a reference frame show, from frame to frame in
/// either direction of time. A point's chain breaks for good where it leaves the matte eroded by
/// `edge_margin_px` (motion next to a region's edge is a mixture), where the motion is not valid,
/// or where the region itself hides it (see landing_is_single()). Motion is interpolated bilinearly
/// between pixels inside that margin only, never across an edge.
///
/// Not thread-safe; calls may use several threads inside, with the same result for any number.
class MotionChain {
  public:
    /// `matte` of the reference frame.
    explicit MotionChain(ViewU8x1 matte, int edge_margin_px = 2);

    /// Goes on to a neighbour frame. `next_from_cur` lies on the current frame's pixels.
    void advance(const FlowField& next_from_cur, ViewU8x1 next_matte);

    /// The same with motion that lies on the neighbour's pixels and points back to the current
    /// frame. It is inverted at each point by fixed-point iteration; a point that does not converge
    /// to within 0.05 px is lost.
    void advance_inverse(const FlowField& cur_from_next, ViewU8x1 next_matte);

    /// On the reference frame's pixels; valid where the point was visible throughout.
    [[nodiscard]] const FlowField& cur_from_ref() const { return cur_from_ref_; }

    /// On the current frame's pixels: the chain's inverse, by drawing the quadrilateral that each
    /// four neighbouring reference pixels have become, as two triangles with linear interpolation.
    /// Valid where a triangle covers the pixel's centre and the pixel is inside the current matte;
    /// where two sheets cover it the first in scanline order of the reference frame is kept.
    [[nodiscard]] FlowField ref_from_cur() const;

  private:
    FlowField cur_from_ref_;
    Matte cur_inside_;
    int margin_px_;
};

/// 255 for each valid pixel of the field if no other pixel with a motion that differs by more than
/// 1 px + 10 % lands in the same target pixel or the eight around it, else 0. Where two sheets of a
/// surface land on each other, one is hidden; without depth it is unknown which, so both are
/// dropped. `inside` (255) restricts the pixels considered.
[[nodiscard]] Matte landing_is_single(const FlowField& target_from_source, ViewU8x1 inside);

/// Bilinear lookup of a field at (x, y) (pixel coordinates, centres at + 0.5), using only taps
/// where `inside` is 255 and the field is valid, with renormalised weights. False if those taps
/// weigh less than a half.
bool lookup_motion(const FlowField& field, ViewU8x1 inside, Vec2 p, Vec2& motion);

}  // namespace weft
