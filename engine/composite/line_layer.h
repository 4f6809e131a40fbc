#pragma once
// Ink lines that cross a region: kept on top of the new texture.

#include "engine/core/image.h"

namespace weft {

struct InkOptions {
    float width_px = 4;     ///< The widest stroke that is ink; wider dark shapes are fill.
    float contrast = 0.2f;  ///< Least darkness of a stroke against both its sides, of white.
};

/// The ink's coverage (0 … 255) by a black top-hat: the display luma's closing by a disc wider than
/// a stroke, less the luma itself (Serra 1982; Meyer 1979), relative to the darkest strokes near
/// by. Strokes on the region's outline are found from the plate on their other side, so the whole
/// frame is looked at; the result is 0 more than `width_px` outside of the matte. The plate's
/// display codes; one size. Deterministic for any number of threads.
[[nodiscard]] Matte extract_ink(ViewU8x3 display, ViewU8x1 matte, const InkOptions& options = {});

/// Lays the plate's ink over a surface, in place: S ← (1 − L) S + L · ink. The ink's colour is the
/// plate's in the core of the strokes within 8 px, at strokes without a core that of all the
/// region's cores; where there is none the plate itself is taken for ink. `lines`: its coverage.
/// All of one size and in one space; where the plate is not finite the surface is left alone.
void lay_lines(ImageView<float, 3> surface, ViewF3 plate, ViewU8x1 lines);

}  // namespace weft
