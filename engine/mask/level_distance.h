#pragma once
// Distances of a soft matte's level sets, to parts of a pixel.

#include "engine/core/image.h"

namespace weft {

/// Signed Euclidean distance in pixels from every pixel's centre to the line where `alpha` (H×W, 0
/// to 1) crosses `level`, positive where alpha ≥ level, clamped to ±`reach_px`. The frame's border
/// is no line. The line is that of marching squares (Lorensen & Cline 1987, in two dimensions); on
/// an edge that is one pixel wide its crossings are taken from the coverage of the pixels around,
/// which is exact for straight edges of any slope (Gustavson & Strand 2011 have the same aim). The
/// distance to the crossings is exact (lower envelope of parabolas, Felzenszwalb & Huttenlocher
/// 2012, along columns and rows), and within 8 px that to the lines between them; farther away the
/// crossings stand for the line, at most 0.04 px off. Time linear in the pixels. Thread-safe; the
/// same for any number of threads.
[[nodiscard]] ImageF1 level_distance(ViewF1 alpha, float level, float reach_px);

}  // namespace weft
