#pragma once
// Internal to the preview: one frame and its earlier stages as pictures.

#include <functional>
#include <optional>
#include <vector>

#include "app/preview/preview.h"
#include "engine/compute/backend.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/region_scene.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// The inputs of render_frame().
struct StageInputs {
    const ShotSource& source;
    const ShotPlan& plan;
    const std::vector<RegionScene>& scenes;
    const AnalysisStore& store;
    const Backend& backend;
};

/// Converts pixels of the output space for display.
using MakePicture = std::function<PicturePtr(const ImageF3&)>;

/// Renders the final picture; with `stages` also the earlier ones, and `layer` if set. `seam`: the
/// visibility of seams, 0–1; null: seams are not measured, which is faster. Errors: those of
/// render_frame().
[[nodiscard]] Expected<PreviewFrame> render_stages(const StageInputs& in, int frame, bool stages,
                                                   std::optional<LayerKind> layer,
                                                   const MakePicture& picture, float* seam);

}  // namespace weft
