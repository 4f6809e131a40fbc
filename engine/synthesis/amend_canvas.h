#pragma once
// Putting an artist's decisions into a finished plane.

#include <vector>

#include "engine/core/cancel.h"
#include "engine/synthesis/canvas.h"
#include "engine/synthesis/sample_atlas.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// Carries out the options' amendments in their order on a canvas that has been grown. Where kept
/// texels differ from what was grown, a rim around them is grown again, with the kept texels and
/// all beyond the rim locked, so that they join by cut seams; where they are the same, nothing
/// changes. What is to be made again is grown once more inside of its own rim, kept texels
/// excepted. Texels that do not lie on the plane, or show what is not in the atlas, are left out.
/// False when it was cancelled.
[[nodiscard]] bool amend_canvas(const SampleAtlas& atlas, const PlaneOptions& options,
                                Canvas& canvas, PlaneStats& stats, const CancelToken& cancel);

}  // namespace weft
