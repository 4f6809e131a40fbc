#pragma once
// The box around a roto shape.

#include "app/project/project.h"
#include "engine/core/pixel_aspect.h"
#include "engine/core/quad.h"
#include "ui/base/ctx.h"
#include "ui/canvas/view_map.h"

namespace weft::ui {

/// The upright box around a shape's outline, larger on every side by a margin of unsqueezed px.
[[nodiscard]] Quad<float> box_of_shape(const RotoShape& shape, float margin,
                                       PixelAspect aspect = {});
/// Turned clockwise on the picture unsqueezed by an angle in radians and scaled, about a pivot;
/// feather grows with the shape.
[[nodiscard]] RotoShape turned_shape(RotoShape shape, Vec2 pivot, float scale, float radians,
                                     PixelAspect aspect = {});

/// The box that rotates and scales the shape. Returns true if a drag has ended that changed it.
bool shape_box(Ctx& c, const ViewMap& map, bool hovered, bool& over);
/// A drag inside of the shape, beside all handles, moves it. Returns true if one has ended that
/// did.
bool shape_inside(Ctx& c, const ViewMap& map, bool active, bool hovered);

}  // namespace weft::ui
