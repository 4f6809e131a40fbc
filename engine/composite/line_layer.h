#pragma once
// Ink lines that cross a region: kept on top of the new texture.

#include "engine/core/image.h"

namespace weft {

struct InkOptions {
    float width_px = 4;  ///< The widest stroke that counts as ink; wider dark shapes are fill.
    /// Least contrast of a stroke against both sides, as a share of white.
    float contrast = 0.2f;
};

/// The ink's coverage (0 … 255) by a black top-hat: the display luma's closing by a disc wider than
/// a stroke, less the luma itself (Serra 1982; Meyer 1979), relative to the darkest strokes near
/// by. Strokes on the region's outline need the plate on their other side, so the whole frame is
/// searched; the result is 0 more than `width_px` outside the matte. `display`: the plate's display
/// codes. All H×W. Deterministic for any number of threads.
[[nodiscard]] Matte extract_ink(ViewU8x3 display, ViewU8x1 matte, const InkOptions& options = {});

/// Lays the plate's ink over a surface, in place: S ← (1 − L) S + L · ink. The ink's colour is the
/// plate's in the core of the strokes within 8 px; at strokes without a core it is that of all the
/// region's cores; if there are none, the plate itself is the ink. `lines`: the ink's coverage. All
/// H×W and in one space. Where the plate is not finite the surface stays.
void lay_lines(ImageView<float, 3> surface, ViewF3 plate, ViewU8x1 lines);

}  // namespace weft
