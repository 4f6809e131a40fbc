#pragma once
// Internal to the viewer.

#include <string>

#include "ui/ctx.h"
#include "ui/view_map.h"

namespace weft::ui {

/// Returns true while the modifier that takes away is held: Ctrl, or Alt, which many window
/// managers keep for moving windows.
[[nodiscard]] bool subtracts();

/// Handles brush input before drawing, so that this frame shows the stroke.
void brush_input(Ctx& c, const ViewMap& map, bool active);
/// Handles shapes and transforms with the mouse, and draws the brush outline.
void viewer_tools(Ctx& c, const ViewMap& map, bool hovered, bool active);
void keep_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);
/// The bar's right part: quality, zoom, view and comparisons. Where it is narrow, the quality only.
void view_controls(Ctx& c, ImVec2 min, ImVec2 max);
/// Applies a texture to the region under the mouse, or to the selected one.
void drop_texture(Ctx& c, const ViewMap& map, const std::string& path);

}  // namespace weft::ui
