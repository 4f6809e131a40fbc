#pragma once
// The form of a surface as another frame shows it.

#include "engine/core/image.h"
#include "engine/form/form_map.h"

namespace weft {

/// All of one size, 0 where nothing is known.
struct ShownForm {
    ImageF3 normal;      ///< Length 1; x to the right, y up, z towards the camera.
    ImageF1 depth;       ///< Along the camera's axis, in the unit of FormMap::relief.
    ImageF1 confidence;  ///< 0 to 1.
};

/// What a frame shows of a form over `box`: the surface of the reference frame, turned and moved as
/// one rigid thing so that its places lie where the frame shows them (a pose by Gauss–Newton under
/// bounded errors). Where they do not, the confidence falls: by half at 1.5 px of 854. It is the
/// finding's belief elsewhere. `ref_from_cur`, `box` and `matte` (of the box) are of a frame that
/// is `smaller` times smaller than the reference frame, in plate pixels. Bit-identical everywhere;
/// thread-safe.
[[nodiscard]] ShownForm form_on_frame(const FormMap& form, const LatticeField& ref_from_cur,
                                      ViewU8x1 matte, const Recti& box, float smaller);

}  // namespace weft
