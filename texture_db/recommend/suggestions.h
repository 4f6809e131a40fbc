#pragma once
// Internal: selects the few samples to show, from all samples scored for a region.

#include "texture_db/recommend/region_scorer.h"

namespace weft {

/// The suggestions of every scheme and the best of all of them; diverse.
[[nodiscard]] RegionSuggestions suggest_for(const SampleIndex& index,
                                            const RecommendRequest& request,
                                            const RegionRequest& region, const RegionLook& look,
                                            const RegionScorer& scorer);

/// The suggestion for a texture that the artist keeps, with its terms and reasons.
[[nodiscard]] Suggestion suggestion_kept(const SampleIndex& index, const RegionScorer& scorer,
                                         std::size_t sample);

}  // namespace weft
