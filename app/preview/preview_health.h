#pragma once
// How a frame fares: figures for the strips below the ruler, from what the preview has anyway.

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"
#include "engine/pipeline/render_frame.h"

namespace weft {

/// Luma over its surroundings, of a small picture: what light does not change much.
[[nodiscard]] ImageF1 small_pattern(const ImageF3& plate, const ColorTransform& display_from_plate,
                                    int factor);

/// How far the surface looks different from what it was on the reference frame, 0 (not at all) to 1
/// (it is something else): the mean over the matte of the difference of the patterns, of which
/// kLostPattern is 1. Below 0 where the matte is empty. Pictures are smaller by `factor`.
[[nodiscard]] float pattern_drift(const ImageF1& now, const ImageF1& reference,
                                  const LatticeField& ref_from_cur, const Matte& matte, int factor);

/// How far the texture is drawn out or squeezed against the reference frame, whichever is more: the
/// mean over the matte; 1 not at all, below 0 where the matte is empty.
[[nodiscard]] float mean_stretch(const LatticeField& ref_from_cur, const Matte& matte);

/// How much the seams of the planes stand out in a rendered frame with layers: how much steeper the
/// picture is there than elsewhere in the patch, 0 (not at all) to 1 (twice as steep). Below 0
/// where no seam is seen.
[[nodiscard]] float seam_prominence(const RenderedFrame& frame);

}  // namespace weft
