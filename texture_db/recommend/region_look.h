#pragma once
// Internal: the appearance of a region of a frame and of its surroundings, for the recommender.

#include <vector>

#include "engine/core/error.h"
#include "texture_db/describe/descriptor_model.h"
#include "texture_db/describe/surface_role.h"
#include "texture_db/recommend/recommend.h"

namespace weft {

struct WeightedColor {
    LabColor color;
    float weight = 0;  ///< Share of the area, 0 … 1.
};

struct RegionLook {
    MeasuredTexture inside;  ///< Mean over samples of the region.
    /// Squares of the plate that represent the region.
    std::vector<Recti> squares;
    std::vector<std::vector<float>> descriptors;  ///< Of those squares; empty without a model.
    /// Likelihoods by the image–text model, by material of the index; empty without one.
    std::vector<float> materials;
    RegionPlace place;
    float area_px = 0;
    float short_side_px = 0;                  ///< Side of a square of the region's typical width.
    std::vector<WeightedColor> surroundings;  ///< Main colours of the rest of the frame.
    float rest_contrast = 0, rest_saturation = 0, rest_roughness = 0;
};

/// Errors: Usage for an empty matte or one of another size than the plate.
[[nodiscard]] Expected<RegionLook> look_at_region(ViewU8x3 plate, const RegionRequest& region,
                                                  const DescriptorModel* model);

/// How well colours go with those of the rest of a frame, by the harmonic templates of Matsuda
/// (Cohen-Or et al. 2006): neighbouring hues and complements harmonise, neutral colours go with
/// all. Immutable.
class ColourHarmony {
  public:
    explicit ColourHarmony(const std::vector<WeightedColor>& others);
    /// 0 … 1, for a colour by its chroma and hue in CIE Lab.
    [[nodiscard]] float with(float chroma, float hue_deg) const;
    [[nodiscard]] float with(const LabColor& color) const;

  private:
    struct Other {
        float chroma = 0, hue_deg = 0, weight = 0;
    };
    std::vector<Other> others_;
    float weight_ = 0, loudest_ = 0;
};
/// Smallest angle between two hues, degrees; 0 if either is neutral.
[[nodiscard]] float hue_difference_deg(const LabColor& a, const LabColor& b);

}  // namespace weft
