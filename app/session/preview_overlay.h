#pragma once
// Internal to the preview: what is drawn over a frame to judge the work by.

#include "app/session/preview.h"
#include "app/session/shot.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_scene.h"

namespace weft {

/// `region`: index among the planned ones. Errors: those of the store.
[[nodiscard]] Expected<OverlayPicture> make_overlay(Overlay kind, const Shot& shot,
                                                    const AnalysisStore& store,
                                                    const RegionScene& scene, int region, int frame,
                                                    const CancelToken& cancel);

}  // namespace weft
