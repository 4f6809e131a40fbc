#pragma once
// Internal: the input of the descriptor: a few hundred numbers of colour, local patterns, oriented
// energies and repetition.

#include <vector>

#include "engine/core/image.h"

namespace weft {

/// Stored with every sample's features; features of another version are computed again.
inline constexpr int kFeatureVersion = 2;

/// Features of a 96×96 sRGB picture. Deterministic; thread-safe; about 3 ms.
[[nodiscard]] std::vector<float> texture_features(ViewU8x3 sample);
[[nodiscard]] int texture_feature_count();

/// The middle 96×96 of a picture; a smaller one is extended by mirroring.
[[nodiscard]] ImageU8x3 middle_sample(ViewU8x3 picture);

/// 0 … 1: how well a plane grown from the sample would hold together. Half of it is how even the
/// sample is (a patch from anywhere fits anywhere), half how cheaply its opposite sides join.
[[nodiscard]] float synthesisability(ViewU8x3 sample);

}  // namespace weft
