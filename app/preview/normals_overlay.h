#pragma once
// Internal to the overlays: the normals of a form as colours.

#include "app/preview/preview.h"
#include "app/shot/shot.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_scene.h"

namespace weft {

/// Fills OverlayPicture::colours for its frame: the plate, and over it 0.5 + 0.5 n inside of
/// OverlayPicture::where. Stays null where the scene has no form. Errors: those of the plate and
/// the store.
[[nodiscard]] Status draw_normals(const Shot& shot, const RegionScene& scene,
                                  const AnalysisStore& store, int region, OverlayPicture& out);

}  // namespace weft
