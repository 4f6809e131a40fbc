#pragma once
// Quality measures of a frame for the strips below the ruler, from data that the preview already
// has.

#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// Luma relative to its surroundings in a small picture, which is nearly independent of lighting.
[[nodiscard]] ImageF1 small_pattern(const ImageF3& plate, const ColorTransform& display_from_plate,
                                    int factor);

/// Appearance change of the surface since the reference frame, from 0 (none) to 1 (unrelated): the
/// mean difference of the patterns over the matte, where kLostPattern is 1. Below 0 if the matte is
/// empty. Pictures are smaller by `factor`.
[[nodiscard]] float pattern_drift(const ImageF1& now, const ImageF1& reference,
                                  const LatticeField& ref_from_cur, const Matte& matte, int factor);

/// Stretch or compression of the texture relative to the reference frame, whichever is larger: the
/// mean over the matte. 1: none; below 0: the matte is empty.
[[nodiscard]] float mean_stretch(const LatticeField& ref_from_cur, const Matte& matte);

}  // namespace weft
