#pragma once
// Internal: selects the parts of a photograph that make good samples, by measurements.

#include <string>
#include <vector>

#include "engine/core/image.h"

namespace weft {

struct ChoiceRules {
    int most = 30;       ///< Samples per picture.
    bool strict = true;  ///< For pictures that nobody selected by hand.
};

/// Why a picture is no texture ("large flat parts", "a border"), or empty.
[[nodiscard]] std::string picture_fault(ViewU8x3 picture, const ChoiceRules& rules);

/// Scales a picture so that a sample shows the material and not just three of its grains: pictures
/// of 1024 px and more are halved until their short side is below that.
[[nodiscard]] ImageU8x3 at_sample_scale(ViewU8x3 picture);

/// 96×96 squares that do not overlap, best first, at most `rules.most`: sharp, neither flat nor
/// overexposed, even over the square, and no two similar. Deterministic.
[[nodiscard]] std::vector<Recti> choose_samples(ViewU8x3 picture, const ChoiceRules& rules);

}  // namespace weft
