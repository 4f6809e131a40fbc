#pragma once
// Which parts of a region move by themselves: cells of one step's raw motion, grouped by it.

#include <algorithm>
#include <cstdint>

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

/// Cells of a frame and the part that each belongs to.
struct MovingParts {
    static constexpr std::uint8_t kBody = 0, kUnknown = 255;

    int cell_px = 8;            ///< Cell (i, j) covers the pixels from (i, j) · cell_px on.
    Image<std::uint8_t, 1> of;  ///< By cell: kBody, a part from 1 on, or kUnknown.
    int count = 0;              ///< Parts beside the body.

    /// Of the pixel (x, y); of those that fill no cell, at the right and below, as their
    /// neighbours.
    [[nodiscard]] std::uint8_t at(int x, int y) const {
        return of.at(std::min(x / cell_px, of.width() - 1), std::min(y / cell_px, of.height() - 1));
    }
};

/// Parts of a region that move otherwise than the body, which is what most of it does, and slide
/// along it: over two fifths of their common boundary the part's motion misses what is beside it by
/// 1.5 px (of a width of 480) or more. What bends departs from the body as well, but is joined to
/// it on all sides. Along stripes and where light moves raw motion errs: these are candidates.
/// Motions are affine, found by consensus among small neighbourhoods (as in Wang & Adelson 1994,
/// whose layers are clusters of these). `visible`: H×W. Pure; deterministic.
[[nodiscard]] MovingParts find_moving_parts(const FlowField& prev_from_cur, ViewU8x1 visible);

}  // namespace weft
