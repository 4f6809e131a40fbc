#pragma once
// What light costs, beside the paper's own synthesis of the same size (the paper, Table 1).

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// CPU seconds, the mean over runs. A frame's light is all that light adds to it: the sample of the
/// plate, the clip's evidence of what is paint, the shading, and the gain on the texture.
struct LightingCost {
    int side = 0;
    double synthesis_s = 0;  ///< The paper's variant: direct scalar search, eq. 2 and 3, max-flow.
    double final_s = 0, draft_s = 0;
};

/// A square plate of each side that is covered by the region wholly. Errors: those of growing.
[[nodiscard]] Expected<std::vector<LightingCost>> bench_lighting(const ImageU8x3& sample,
                                                                 const std::vector<int>& sides,
                                                                 int runs);
[[nodiscard]] std::string lighting_line(const LightingCost& cost);
[[nodiscard]] nlohmann::ordered_json lighting_json(const std::vector<LightingCost>& costs);

}  // namespace weft
