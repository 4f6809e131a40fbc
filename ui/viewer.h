#pragma once
// Internal to the viewer.

#include <string>

#include "ui/ctx.h"
#include "ui/view_map.h"

namespace weft::ui {

/// What the brush does: before the picture is drawn, so that this frame's picture has it.
void brush_input(Ctx& c, const ViewMap& map, bool active);
/// Shapes and placing with the mouse on the canvas, and the brush's ring.
void viewer_tools(Ctx& c, const ViewMap& map, bool hovered, bool active);
void keep_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);
/// Applies a texture to the region under the mouse, or to the selected one.
void drop_texture(Ctx& c, const ViewMap& map, const std::string& path);

}  // namespace weft::ui
