#pragma once
// What moves otherwise than the background in a surface's colours, in connected pieces.

#include <cstdint>

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/mask/surface_palette.h"

namespace weft {

/// A frame of a walk, all of one size.
struct MotionReturnInput {
    ViewU8x3 frame;         ///< Display codes.
    ViewF1 phi;             ///< Signed distance of what was found of the surface, px.
    const FlowField& flow;  ///< prev_from_cur as measured.
    ViewF1 departs;         ///< Log odds for inside by each pixel's motion (Departure::departs()).
    const SurfacePalette& palette;
    float unit_px = 1;  ///< A pixel of 854×480.
};

/// It is gathered on each such pixel of the frame in x and y.
inline constexpr int kMotionEvidenceStep = 2;

/// Log odds for inside by motion (−3 to 3) and colour (−2 to 2), averaged near by, of the frame's
/// size divided by kMotionEvidenceStep, rounded up. Parallel over rows; deterministic.
[[nodiscard]] ImageF1 motion_evidence(const MotionReturnInput& in);

using PieceLabels = Image<std::int32_t, 1>;  ///< From 1 on; 0: of no piece.

/// Which piece of odds above `least` each pixel is of. Pieces that nearly touch are one.
[[nodiscard]] PieceLabels motion_pieces(ViewF1 odds, float least, float unit_px);

}  // namespace weft
