#pragma once
// How well a frame shows a surface, judged by its matte alone.

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// What a matte shows of a surface on one frame.
struct SurfaceVisibility {
    double full_px = 0;     ///< Coverage of the matte, in pixels.
    double visible_px = 0;  ///< The same outside the holdout.
    double cut = 0;         ///< Share of the outline that lies on the picture's border, 0–1.
    double soft = 0;        ///< Share of the covered pixels that are partly covered, 0–1.

    /// Grows with the visible area. Surfaces that are partly hidden, cut by the border or blurred
    /// by motion score less. 0: not visible.
    [[nodiscard]] double score() const;
};

/// `holdout`: of the matte's size, or empty. A pure function.
[[nodiscard]] SurfaceVisibility surface_visibility(ViewU8x1 matte, ViewU8x1 holdout);

/// The frame to use as reference, as an index into the scores of frames in order. The first is kept
/// while it has half of the best score, because surfaces of ordinary shots vary that much in size.
/// Otherwise it is the first with 90 % of the best score. Empty if all scores are 0.
[[nodiscard]] std::optional<std::size_t> first_well_shown(const std::vector<double>& scores);

}  // namespace weft
