#pragma once
// Predicts a shape in the next frame. Its signed distance moves along the motion of its own
// surface, measured inside the shape, so that the background's motion does not tear its edge.

#include "engine/core/fields.h"
#include "engine/core/image.h"
#include "engine/mask/boundary_refiner.h"
#include "engine/mask/surface_palette.h"
#include "engine/mask/uncovered.h"

namespace weft {

struct TransportedShape {
    ImageF1 phi;             ///< Expected signed distance, pixels, at the area's size.
    ImageF2 prev_from_cur;   ///< The surface's motion, extended outwards, pixels.
    ImageF2 outside_motion;  ///< The same of what surrounds the surface, extended inwards.
    UncoveredParts uncovered;
    float consistency = 1;  ///< Share of the boundary's surroundings with reliable motion, 0–1.
};

/// Bounds of the pixels whose motion leads inside the shape; empty if there are none.
[[nodiscard]] Recti transported_bounds(ViewF1 prev_phi, const FlowField& prev_from_cur);

/// The shape on the frame before.
struct PreviousShape {
    ViewF1 phi;   ///< Signed distance, pixels …
    ViewF1 seen;  ///< … and the same, 0 where something in front hid it.
};

/// What the frame's area shows, and the colours that the surface has.
struct ShownArea {
    ViewU8x3 frame;  ///< Display codes, of the area's size.
    const SurfacePalette& palette;
};

/// `prev` and `prev_from_cur` are of the frame's size, `area` lies in it. `hidden`, of the same
/// size or empty: where something is in front (motion_behind()); what is seen near by counts more.
/// `uncovered`, of the walk: what is revealed is not expected to be the surface, and no more is
/// what has come over the picture's border and shows other colours (foreign_entries()).
[[nodiscard]] TransportedShape transport_shape(const PreviousShape& prev,
                                               const FlowField& prev_from_cur,
                                               const ShownArea& shown, const Recti& area,
                                               const RefineScale& scale, Uncovered& uncovered,
                                               ViewU8x1 hidden = {});

}  // namespace weft
