#pragma once
// Internal: selects the few samples to show, from all samples scored for a region.

#include "texture_db/recommend/suitability.h"

namespace weft {

/// The suggestions of every scheme and the best of all of them; diverse.
[[nodiscard]] RegionSuggestions suggest_for(const SampleIndex& index,
                                            const RecommendRequest& request,
                                            const RegionRequest& region, const RegionLook& look,
                                            const RegionJudge& judge);

/// The suggestion for a texture that the artist keeps, with its terms and reasons.
[[nodiscard]] Suggestion suggestion_kept(const SampleIndex& index, const RegionJudge& judge,
                                         std::size_t sample);

}  // namespace weft
