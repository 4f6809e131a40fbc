#pragma once
// Internal: out of all samples that a region was judged for, the few that are shown.

#include "texture_db/recommend/suitability.h"

namespace weft {

/// The suggestions of every scheme and the best of all of them; diverse.
[[nodiscard]] RegionSuggestions suggest_for(const SampleIndex& index,
                                            const RecommendRequest& request,
                                            const RegionRequest& region, const RegionLook& look,
                                            const RegionJudge& judge);

/// A texture that the artist keeps, with its parts and reasons.
[[nodiscard]] Suggestion suggestion_kept(const SampleIndex& index, const RegionJudge& judge,
                                         std::size_t sample);

}  // namespace weft
