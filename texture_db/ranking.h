#pragma once
// Internal: the order in which a library's samples are shown for a picture.

#include <span>
#include <vector>

#include "texture_db/descriptor_model.h"
#include "texture_db/index.h"

namespace weft {

/// By a sample's own distance and seven tenths of that of its material's middle. The first five are
/// of five materials, the nearest of each, since what a picture shows is not sure; then all others.
/// Distances as they were compared.
[[nodiscard]] std::vector<Neighbour> rank_for_picture(const SampleIndex& index,
                                                      const DescriptorModel& model,
                                                      std::span<const float> descriptor,
                                                      std::size_t count);

}  // namespace weft
