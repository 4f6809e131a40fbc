#pragma once
// What things in front of a surface hide of it: it is still there, and the picture says nothing of
// it.

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// 255 where `in_front` (a matte) covers a pixel or one beside it; empty if it does so nowhere.
[[nodiscard]] Matte hidden_part(ViewU8x1 in_front);

/// The larger code of each pixel, such as of two things that are not known to be of either side.
/// `a` may be empty.
[[nodiscard]] Matte either_of(const Matte& a, const Matte& b);

/// A signed distance with 0, neither inside nor outside, where `hidden`; both have one size.
[[nodiscard]] ImageF1 seen_distance(const ImageF1& phi, const Matte& hidden);
/// Of another boundary: what was hidden in `seen` stays so. An empty `seen` stays empty; else both
/// have one size.
void move_seen(ImageF1& seen, ViewF1 phi);

/// Where `hidden`, which is of the frame's size, the shape stays as expected: the log odds of an
/// area at `origin` become decisive near the boundary and 0 further off. `expected_phi`: signed
/// distance, pixels.
void keep_hidden(ImageF1& near_odds, ImageF1& wide_odds, const ImageF1& expected_phi,
                 const Matte& hidden, Vec2i origin);

/// Motion as measured, in which what is `hidden` does not move with what is in front. It follows
/// the plane that what is seen of the surface moves by, and is not `valid`; if less than a quarter
/// is seen, it moves with the background instead, beside the occluder too, where motion is mixed.
/// `prev_phi`: the surface's signed distance on the frame before, pixels. Deterministic.
[[nodiscard]] FlowField motion_behind(const FlowField& measured, const Matte& hidden,
                                      const ImageF1& prev_phi, float band_px);

}  // namespace weft
