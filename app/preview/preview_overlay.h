#pragma once
// Internal to the preview: diagnostic overlays.

#include "app/preview/preview.h"
#include "app/shot/shot.h"
#include "engine/core/cancel.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_scene.h"

namespace weft {

/// Belongs to one thread. Caches the map of the last plane.
class OverlayMaker {
  public:
    /// `region`: index among planned regions. Errors: those of the store and of synthesis.
    [[nodiscard]] Expected<OverlayPicture> make(Overlay kind, const Shot& shot,
                                                const AnalysisStore& store,
                                                const RegionScene& scene, int region, int frame,
                                                const CancelToken& cancel);

  private:
    [[nodiscard]] Expected<std::shared_ptr<const PlaneMap>> plane_map(const Shot& shot, int region,
                                                                      const RegionScene& scene,
                                                                      const CancelToken& cancel);
    std::shared_ptr<const PlaneMap> map_;
    std::uint64_t map_of_ = 0;  // PlanePyramid::identity()
};

}  // namespace weft
