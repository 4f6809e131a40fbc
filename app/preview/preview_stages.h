#pragma once
// Internal to the preview: one frame, and the steps on the way to it, as pictures.

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

/// As render_frame() takes them.
struct StageInputs {
    const ShotSource& source;
    const ShotPlan& plan;
    const std::vector<RegionScene>& scenes;
    const AnalysisStore& store;
    const Backend& backend;
};

/// Pixels of the output space as they are shown.
using MakePicture = std::function<PicturePtr(const ImageF3&)>;

/// The final picture, where `stages` those before it, and `layer` where it is named. `seam`: how
/// much the seams stand out, 0–1. Errors: those of render_frame().
[[nodiscard]] Expected<PreviewFrame> render_stages(const StageInputs& in, int frame, bool stages,
                                                   std::optional<LayerKind> layer,
                                                   const MakePicture& picture, float& seam);

}  // namespace weft
