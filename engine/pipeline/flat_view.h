#pragma once
// What one frame shows of a surface, without its light.

#include "engine/compute/backend.h"
#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/motion/lattice_field.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/flat_layout.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/region_scene.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// A frame's surface as its texture would have to be for a render to show the frame: the plate
/// divided by the light that a render puts on.
struct UnlitFrame {
    Recti box;       ///< Of the frame; empty: it shows nothing of the surface.
    ImageF3 colour;  ///< The box's size, working space; finite where trust is above 0.
    ImageF1 trust;   ///< 0 to 1: 0 off the surface, little at its edge and where it is burnt out.
    LatticeField ref_from_cur;
};

/// `scene`: of make_scene(). Thread-safe as its arguments are. Errors: those of source and store.
[[nodiscard]] Expected<UnlitFrame> unlit_frame(const ShotSource& source, const ShotPlan& plan,
                                               const AnalysisStore& store, int region,
                                               const RegionScene& scene, int frame);

/// The box of places on the reference frame, px, that the frame's surface takes; at most `most_px`
/// beyond `plate` on each side.
[[nodiscard]] Recti places_of(const UnlitFrame& frame, Size plate, int most_px);

/// What the frame shows beyond a render of the flat picture `plane` (of the layout): its colour is
/// the difference. Thread-safe.
[[nodiscard]] UnlitFrame beyond_plane(const UnlitFrame& frame, const FlatLayout& layout,
                                      const PlanePyramid& plane, const Backend& backend);

/// A frame on rows of the flat picture.
struct FlatView {
    ImageF3 colour;  ///< Unspecified where weight is 0.
    ImageF1 weight;  ///< Trust × how finely the frame shows the place; 0: not at all.
};
/// `rows`: first and behind the last row of the picture.
[[nodiscard]] FlatView flat_view(const UnlitFrame& frame, const FlatLayout& layout, int first_row,
                                 int end_row);

}  // namespace weft
