#pragma once
// Internal: what a region of a frame and its surroundings look like, for the recommender.

#include <vector>

#include "engine/core/error.h"
#include "texture_db/descriptor_model.h"
#include "texture_db/recommend.h"

namespace weft {

struct WeightedColor {
    LabColor color;
    float weight = 0;  ///< Share of the area, 0 … 1.
};

struct RegionLook {
    MeasuredTexture inside;                       ///< Mean over samples of the region.
    std::vector<std::vector<float>> descriptors;  ///< Of those samples; empty without a model.
    float area_px = 0;
    float short_side_px = 0;                  ///< Of a square of the region's typical width.
    std::vector<WeightedColor> surroundings;  ///< Main colours of the rest of the frame.
    float rest_contrast = 0, rest_saturation = 0, rest_roughness = 0;
};

/// Errors: Usage for an empty matte or one of another size than the plate.
[[nodiscard]] Expected<RegionLook> look_at_region(ViewU8x3 plate, const RegionToSuit& region,
                                                  const DescriptorModel* model);

/// 0 … 1: how well a colour goes with others, after the harmonic templates of Matsuda (Cohen-Or et
/// al. 2006): neighbouring hues and complements harmonise, neutral colours go with all.
[[nodiscard]] float colour_harmony(const LabColor& color, const std::vector<WeightedColor>& others);
/// Smallest turn between two hues, degrees; 0 when either is neutral.
[[nodiscard]] float hue_difference_deg(const LabColor& a, const LabColor& b);

}  // namespace weft
