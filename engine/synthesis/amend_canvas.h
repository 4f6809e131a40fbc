#pragma once
// Applies an artist's locked and regenerated patches to a finished plane.

#include <vector>

#include "engine/core/cancel.h"
#include "engine/synthesis/canvas.h"
#include "engine/synthesis/plane_structure.h"
#include "engine/synthesis/sample_atlas.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// Applies the options' amendments in order to a grown canvas. Where kept texels differ from the
/// grown ones, a rim around them is grown again with the kept texels and everything beyond the rim
/// locked, so that they join by cut seams. Where they are equal, nothing changes. Texels to
/// regenerate are grown again inside a rim of their own, except for kept texels. Texels that lie
/// outside the plane, or come from outside the atlas, are ignored. False if cancelled.
[[nodiscard]] bool amend_canvas(const SampleAtlas& atlas, const PlaneOptions& options,
                                const PlaneStructure& structure, Canvas& canvas, PlaneStats& stats,
                                const CancelToken& cancel);

}  // namespace weft
