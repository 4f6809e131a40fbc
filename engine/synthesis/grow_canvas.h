#pragma once
// The stages of growing: the first sweep, cutting all seams again, blocks over the worst seams.

#include "engine/core/cancel.h"
#include "engine/core/error.h"
#include "engine/core/progress.h"
#include "engine/synthesis/canvas.h"
#include "engine/synthesis/plane_structure.h"
#include "engine/synthesis/sample_atlas.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// Fills the unfilled part of the canvas, whose size and torus are those of the options, and
/// refines it if the options say so. False if cancelled. Adds to the stage times, counts and peak
/// bytes.
[[nodiscard]] bool grow_canvas(const SampleAtlas& atlas, const PlaneOptions& options,
                               const PlaneStructure& structure, Canvas& canvas, PlaneStats& stats,
                               const CancelToken& cancel, const ProgressFn& progress);

/// The error of a growth that was cancelled.
[[nodiscard]] inline tl::unexpected<Error> growth_stopped(const CancelToken& cancel) {
    return fail(static_cast<ErrorCode>(cancel.reason()), "Growing the texture plane was stopped.");
}

}  // namespace weft
