#pragma once
// The measured motion of what moves as one plane or as one stiff piece.

#include <vector>

#include "engine/core/fields.h"
#include "engine/motion/plane_fit.h"

namespace weft {

/// A pixel and where the motion measured there leads.
[[nodiscard]] inline PlacePair pair_at(const FlowField& flow, int x, int y) {
    const float* d = flow.d.pixel(x, y);
    const Vec2 p(static_cast<float>(x), static_cast<float>(y));
    return {p, p + Vec2(d[0], d[1])};
}

/// Fitted robustly, of four pairs for each parameter on; fewer give their median displacement.
[[nodiscard]] inline glm::dmat3 fit_piece(const std::vector<PlacePair>& pairs) {
    return fit_plane(pairs, {.rounds = 6, .fewest = 32, .from_median = true});
}

}  // namespace weft
