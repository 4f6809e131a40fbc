#pragma once
// A matte from lines that lie surely inside and surely outside of a surface.

#include "engine/core/image.h"

namespace weft {

/// Segments the picture by graph cuts on colours (Rother, Kolmogorov, Blake: GrabCut, 2004). `keep`
/// and `drop` mark certain inside and outside (above 127). Computed on a crop around them, at up to
/// 512 px; the rest of `before` is unchanged, and the matte found goes on into it without a step at
/// the border of the crop. Where nothing was painted before, a surface that reaches the border is
/// looked for in the whole picture. Without a line in
/// `drop`, and where less than three quarters of its outline lie on edges of the picture, it is
/// only taken within reach of the lines: half of their extent, a 32nd of the picture's longest
/// side, 24 px, whichever is most.
[[nodiscard]] Matte segment_scribbles(const Matte& before, ViewU8x3 picture, const Matte& keep,
                                      const Matte& drop);

/// Whether the matte ends where the picture has edges, at least on three quarters of its outline;
/// the picture's borders count as edges.
[[nodiscard]] bool ends_at_edges(const Matte& matte, ViewU8x3 picture);

}  // namespace weft
