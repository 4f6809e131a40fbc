#pragma once
// The border of an overlap and how the ties divide it.

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/seam/corner_grid.h"
#include "engine/seam/seam.h"

namespace weft {

/// The stretches of border between ties, as corners of `CornerGrid(cells.size())`. Walking
/// clockwise (the overlap on the right hand), `start` follows the arc that is tied to the old side
/// and `end` the new one; `others` lie between two ties of one side and have at least two corners.
struct BorderStretches {
    CornerGroup start, end;
    std::vector<CornerGroup> others;
};

/// Empty unless the overlap is one piece without holes, its border has one arc tied to the old side
/// and one tied to the new side, and every tied pixel is connected to its arc. The minimum cut is
/// then a shortest path from `start` to `end`.
[[nodiscard]] std::optional<BorderStretches> border_stretches(const Image<SeamCell, 1>& cells);

}  // namespace weft
