#pragma once
// What a frame shows for the first time, because something that was in front of it has moved on.
// Between two motions that part it has none of its own, and is easily taken for either side.

#include "engine/core/fields.h"
#include "engine/core/geometry.h"
#include "engine/core/image.h"
#include "engine/mask/local_color.h"
#include "engine/mask/surface_palette.h"

namespace weft {

/// Views of the area have one size and lie at `area` in the full-size ones.
struct UncoveredInput {
    const FlowField& flow;  ///< prev_from_cur as measured, `valid` where it leads there and back.
    ViewF1 prev_phi;        ///< Signed distance on the frame before, pixels …
    ViewF1 prev_seen;       ///< … and the same, 0 where something in front hid the surface.
    ViewF2 surface_motion;  ///< prev_from_cur of the surface, extended outwards, pixels.
    ViewF2 outside_motion;  ///< The same of what surrounds it, extended inwards.
    Recti area;
    float band_px = 0;
};

/// Both are of the area's size, 255 where it is so.
struct UncoveredParts {
    Matte appearing;  ///< Was not seen before, and may be what lies behind the surface.
    Matte revealed;   ///< Of this, what would have been seen before if it were the surface.
};

/// 255 where pixels of `area` have no valid motion and share the places that they come from, since
/// motions part: nothing on the frame before looks like them. `flow`: prev_from_cur of the frame.
/// Of the area's size. Parallel over rows; deterministic.
[[nodiscard]] Matte parting_pixels(const FlowField& flow, const Recti& area);

class Uncovered {
  public:
    /// A pixel was hidden before if its motion is not valid, since nothing of the frame before
    /// looks like it, and if several pixels come from where it seems to, since the motions on
    /// either side part. What is `revealed` is joined to what lies outside; what looks so in the
    /// middle of the surface was only hard to compare. If that is often so (motion blur, stripes,
    /// noise), in the mean over some frames, nothing is taken for uncovered. Deterministic.
    [[nodiscard]] UncoveredParts advance(const UncoveredInput& in);

  private:
    float alone_ = -1;  // the mean share of the surface that only looks so; below 0: no frame yet
};

/// Corrects the log odds for inside of what is `appearing`, all of one size. The clean plate has no
/// word for inside (`wide_odds`), since it is another thing that differs from it, too. Where no
/// window of `colors` is near or none separates, the whole surface's palette decides (`near_odds`),
/// where they find it like neither side, the palette if it is sure. Parallel over rows.
void judge_uncovered(ViewU8x3 frame, const UncoveredParts& uncovered, const LocalColorField& colors,
                     const SurfacePalette& palette, ImageF1& near_odds, ImageF1& wide_odds);

}  // namespace weft
