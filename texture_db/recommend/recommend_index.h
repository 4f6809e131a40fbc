#pragma once
// Internal: suggestions from an index.

#include "texture_db/catalogue/index.h"
#include "texture_db/describe/descriptor_model.h"
#include "texture_db/recommend/recommend.h"
#include "texture_db/search/search.h"

namespace weft {

/// TextureLibrary::recommend() with full ids and 1 to 100 suggestions; `index` has samples, `model`
/// may be null. Pure, except for the image–text model's own state.
[[nodiscard]] Expected<Recommendation> recommend_from(const SampleIndex& index,
                                                      const DescriptorModel* model,
                                                      const LibraryEmbeddings& embeddings,
                                                      const RecommendRequest& request);

}  // namespace weft
