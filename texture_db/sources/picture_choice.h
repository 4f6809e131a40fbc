#pragma once
// Internal: which parts of a photograph make good samples, judged by looking.

#include <string>
#include <vector>

#include "engine/core/image.h"

namespace weft {

struct ChoiceRules {
    int most = 30;       ///< Samples of one picture.
    bool strict = true;  ///< For pictures that nobody has chosen by hand.
};

/// Why a picture is no texture ("large flat parts", "a border"), or empty.
[[nodiscard]] std::string picture_fault(ViewU8x3 picture, const ChoiceRules& rules);

/// A picture scaled so that a sample shows some of the material and not three of its grains:
/// pictures of 1024 px and more are halved until their short side is below that.
[[nodiscard]] ImageU8x3 at_sample_scale(ViewU8x3 picture);

/// 96×96 squares that do not overlap, best first, at most `rules.most`: sharp, neither flat nor
/// blown out, even over the square, and none like another. Deterministic.
[[nodiscard]] std::vector<Recti> choose_samples(ViewU8x3 picture, const ChoiceRules& rules);

}  // namespace weft
