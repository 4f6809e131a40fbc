#pragma once
// The new surface into the plate: O = F + M (T − B) (method: "Composite").

#include "engine/core/image.h"

namespace weft {

/// B: the old surface's colour, H×W×3, in the space of `plate` (linear light). Equal to the plate
/// where `matte` is 255, continued from there into soft pixels (1 to 254), 0 elsewhere. NaN and
/// infinity are ignored and filled. In soft pixels B makes O = F + M (T − B) the most likely
/// picture: it removes the pixel's own share of the old pattern, and what a matte that is too wide
/// or too narrow leaves. It may therefore lie outside the surface's colours, or below 0, where
/// matte and plate disagree. If no pixel near by has matte 255, B = F (the plain mix). Uses pixels
/// within 96 px of the soft ones.
[[nodiscard]] ImageF3 unmix_surface(ViewF3 plate, ViewU8x1 matte);

/// The B with which a new surface goes through `shown` where the old one is covered by `matte`:
/// edge tools have moved the edge. Where no more is shown than is covered, the above. Where more
/// is, O has nothing of the old surface and the background behind it, freed of it. `shown` equal to
/// `matte`: the same bytes as above.
[[nodiscard]] ImageF3 unmix_surface(ViewF3 plate, ViewU8x1 matte, ViewU8x1 shown);

/// Writes O into `out` where matte > 0 and leaves the other pixels. Where matte is 255, O is
/// exactly T. All H×W, linear light. Where `plate` is NaN or infinite, O = T, channel by channel.
/// Values above 1 are kept; negative ones become 0 unless the plate itself is negative there.
void composite_over(ImageView<float, 3> out, ViewF3 plate, ViewF3 surface, ViewU8x1 matte,
                    ViewF3 texture);

/// Soft shoulder for display-referred output: identity up to `knee`, then approaches 1. Returns the
/// number of pixels of the matte that exceeded 1 before. Linear light. All three channels are
/// scaled by the factor of the highest, so the hue stays; +infinity becomes 1, and NaN beside a
/// value above the knee becomes 0. On soft pixels the plate's share keeps its value; pixels with
/// matte 0 are unchanged.
[[nodiscard]] long roll_off(ImageView<float, 3> rgb, ViewU8x1 matte, float knee = 0.9f);

/// The knee from which roll_off() brings `peak` (linear light) to 250 of 255 sRGB codes: 0.9 for
/// peaks up to 1, lower for brighter ones, so that what lies between keeps its steps; at least 0.5,
/// which peaks from 5.5 on have.
[[nodiscard]] float roll_off_knee(float peak);

}  // namespace weft
