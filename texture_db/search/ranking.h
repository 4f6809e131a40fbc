#pragma once
// Internal: the order of a library's samples for a picture.

#include <span>
#include <vector>

#include "texture_db/catalogue/index.h"
#include "texture_db/describe/descriptor_model.h"

namespace weft {

/// Ordered by a sample's own distance plus 0.7 times that of its material's centre. The first five
/// are the nearest of five materials, because the picture's material is uncertain; then all others.
/// `distance` is the compared value.
[[nodiscard]] std::vector<Neighbour> rank_for_picture(const SampleIndex& index,
                                                      const DescriptorModel& model,
                                                      std::span<const float> descriptor,
                                                      std::size_t count);

/// The nearest to a sample of the index, best first, without the sample itself.
[[nodiscard]] std::vector<SearchHit> similar_to_sample(const SampleIndex& index, std::size_t sample,
                                                       int count);
/// The samples for a picture's features, in the order of rank_for_picture().
[[nodiscard]] std::vector<SearchHit> similar_to_picture(const SampleIndex& index,
                                                        const DescriptorModel& model,
                                                        std::span<const float> features, int count);

}  // namespace weft
