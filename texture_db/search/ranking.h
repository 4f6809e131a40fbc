#pragma once
// Internal: the order in which a library's samples are shown for a picture.

#include <span>
#include <vector>

#include "texture_db/catalogue/index.h"
#include "texture_db/describe/descriptor_model.h"

namespace weft {

/// By material of the index: the least of what its samples are away, a sample's own distance and
/// seven tenths of that of its material's middle; very far for one that the model does not know.
[[nodiscard]] std::vector<float> material_distances(const SampleIndex& index,
                                                    const DescriptorModel& model,
                                                    std::span<const float> descriptor);

/// By a sample's own distance and seven tenths of that of its material's middle. The first five are
/// of five materials, the nearest of each, since what a picture shows is not sure; then all others.
/// Distances as they were compared.
[[nodiscard]] std::vector<Neighbour> rank_for_picture(const SampleIndex& index,
                                                      const DescriptorModel& model,
                                                      std::span<const float> descriptor,
                                                      std::size_t count);

/// The nearest to a sample of the index, best first, the sample itself left out.
[[nodiscard]] std::vector<SearchHit> similar_to_sample(const SampleIndex& index, std::size_t sample,
                                                       int count);
/// The samples for a picture's features, as rank_for_picture() orders them.
[[nodiscard]] std::vector<SearchHit> similar_to_picture(const SampleIndex& index,
                                                        const DescriptorModel& model,
                                                        std::span<const float> features, int count);

}  // namespace weft
