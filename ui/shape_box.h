#pragma once
#include "app/project/project.h"
#include "engine/core/quad.h"

namespace weft::ui {

/// The upright box around a shape's outline, `margin` px larger on every side.
[[nodiscard]] Quad<float> box_of_shape(const RotoShape& shape, float margin);
/// Turned clockwise on screen by an angle in radians and scaled, about a pivot; feather grows with
/// the shape.
[[nodiscard]] RotoShape turned_shape(RotoShape shape, Vec2 pivot, float scale, float radians);

}  // namespace weft::ui
