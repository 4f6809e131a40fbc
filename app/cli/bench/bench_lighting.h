#pragma once
// Cost of relighting, compared with the paper's own synthesis at the same size (the paper, Table
// 1).

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// The CPU time of this process so far, all threads together.
[[nodiscard]] double cpu_s();

/// CPU seconds, mean over runs. A frame's relighting includes sampling the plate, separating paint
/// from light over the clip, the shading, and the gain on the texture.
struct LightingCost {
    int side = 0;
    double synthesis_s = 0;  ///< The paper's variant: direct scalar search, eq. 2 and 3, max-flow.
    double final_s = 0, draft_s = 0;
};

/// Measures a square plate of each side length, fully covered by the region. Errors: those of
/// synthesis.
[[nodiscard]] Expected<std::vector<LightingCost>> bench_lighting(const ImageU8x3& sample,
                                                                 const std::vector<int>& sides,
                                                                 int runs);
[[nodiscard]] std::string lighting_line(const LightingCost& cost);
[[nodiscard]] nlohmann::ordered_json lighting_json(const std::vector<LightingCost>& costs);

}  // namespace weft
