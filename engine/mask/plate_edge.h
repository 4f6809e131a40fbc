#pragma once
// The edge of a matte at the plate's own size. Mattes are propagated at matte_size(); what a larger
// plate adds is where exactly the edge lies, within a pixel or two of the smaller one.

#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/mask/matte_propagation.h"

namespace weft {

/// The size at which mattes are propagated: the plate's own up to 1920×1080 pixels in all, else of
/// its shape with as many. A matte's details are finer than what motion is measured by, so this is
/// more than follow_size(); at half of it the gaps between a car's doors are lost.
[[nodiscard]] Size matte_size(Size plate);

/// A matte that was found on a smaller plate, at the size of `frame` (display-encoded, H×W×3, not
/// smaller than `small` either way). The boundary is cut again along the edges of `frame`, no
/// farther from the enlarged one than a pixel and a half of `small` and one of `frame`; where
/// `in_front` (H×W, what passes in front; may be empty) hides it, it stays. With
/// `options.soft_edges` edges that are soft in `small` follow the strands in `frame`. Pure; the
/// same for any number of threads.
[[nodiscard]] Matte at_plate_size(ViewU8x1 small, ViewU8x3 frame, ViewU8x1 in_front,
                                  const MatteOptions& options);

/// The same without a look at the plate: bilinear, with its edge as steep in pixels as it was.
/// `gain`: pixels of `to` per pixel of `matte`, along both axes.
[[nodiscard]] Matte enlarged(const Matte& matte, Vec2 gain, Size to);

}  // namespace weft
