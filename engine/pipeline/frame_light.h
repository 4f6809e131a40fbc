#pragma once
// One region's light on one frame: found, changed as the artist asks, and put on the texture.

#include <optional>

#include "engine/lighting/highlights.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/region_scene.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// What the light of a region on a frame follows from. All of it outlives the FrameLight.
struct FrameLightInputs {
    const ShotSource& source;
    const ShotPlan& plan;
    const AnalysisStore& store;
    int index;  ///< Of the region.
    int frame;
    const ImageF3& working;  ///< The plate in the working space.
    const RegionScene& scene;
    const Matte& matte;  ///< Of the old surface, of the plate's size; without edge tools.
    Recti box;           ///< That bounds it, and where the new surface goes.
};

class FrameLight {
  public:
    /// Errors: those of the source and of the store.
    [[nodiscard]] static Expected<FrameLight> find(const FrameLightInputs& inputs);

    [[nodiscard]] const FrameLightInputs& inputs() const { return in_; }
    /// With light detail, zones and strengths above 1 in it; empty: none.
    [[nodiscard]] const std::optional<Shading>& shading() const { return shading_; }
    /// Where the plate shows the old surface within `inside`, of the box's size: what is beyond it
    /// takes nothing of the plate over.
    [[nodiscard]] Matte on_surface(ViewU8x1 inside) const;
    /// With λ that is left to be applied, 0–1, and the limits of this frame.
    [[nodiscard]] const LightOptions& options() const { return options_; }
    /// The share of white that lies over the frame (white_share()).
    [[nodiscard]] float white() const { return white_; }
    /// True if nothing else is left of the surface.
    [[nodiscard]] bool all_white() const { return white_ > 0.97f; }
    /// Lights the texture over the box; `inside` is the matte there. Returns the gloss that is on
    /// it then; empty: none. Errors: those of the source.
    [[nodiscard]] Expected<ImageF3> apply(ViewU8x1 inside, ImageF3& texture) const;

  private:
    explicit FrameLight(const FrameLightInputs& inputs) : in_(inputs) {}
    [[nodiscard]] const RegionPlan& region() const {
        return in_.plan.regions[static_cast<std::size_t>(in_.index)];
    }
    [[nodiscard]] Status change();
    void follow_fade();
    [[nodiscard]] Status find_white();
    void tint(ViewU8x1 inside, ImageF3& texture) const;
    [[nodiscard]] Status put_light(ViewU8x1 inside, ImageF3& texture) const;
    [[nodiscard]] Expected<MovingGloss> moving_gloss_here(ViewU8x1 inside) const;
    [[nodiscard]] Expected<ImageF3> put_gloss(ViewU8x1 inside, ImageF3& texture) const;

    FrameLightInputs in_;
    std::optional<Shading> shading_;
    LightOptions options_;
    float white_ = 0;
};

}  // namespace weft
