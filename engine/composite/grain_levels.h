#pragma once
// Grain's variance by luma, from places that also show other differences.

#include <array>
#include <vector>

#include "engine/composite/grain.h"

namespace weft {

/// What was measured at a place. Variances in squared display units.
struct GrainPlace {
    float luma = 0;
    float variance = 0;
    float detail = 0;  ///< Energy of the picture's own fine detail there, without the grain.
    float spread = 1;  ///< Deviation of `variance` from chance alone, as a share of it.
};

struct GrainLevels {
    std::array<double, GrainModel::kBins> variance{};  ///< At the middle of each step of luma, ≥ 0.
    double of_detail = 0;                              ///< Variance per unit of detail, ≥ 0.
    std::vector<float> confidence;  ///< By place, 0 to 1: how far it shows grain alone.
};

/// The lower edge of the places' variance: a line between the steps of luma, plus a share of their
/// detail. Grain is everywhere; aliasing, motion errors and moving light only add to it. Without
/// places all is 0.
[[nodiscard]] GrainLevels grain_levels(const std::vector<GrainPlace>& places);

}  // namespace weft
