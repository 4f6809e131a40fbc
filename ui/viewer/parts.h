#pragma once
// Internal: parts of the viewer.

#include <string>

#include "ui/base/ctx.h"
#include "ui/canvas/view_map.h"

namespace weft::ui {

/// Gives the mouse to the tool in hand.
void viewer_tools(Ctx& c, const ViewMap& map, bool hovered, bool active);
/// The bar's right part: quality, zoom, view and comparisons. Where it is narrow, the quality only.
void view_controls(Ctx& c, ImVec2 min, ImVec2 max);
/// Applies a texture to the region under the mouse, or to the selected one.
void drop_texture(Ctx& c, const ViewMap& map, const std::string& path);

}  // namespace weft::ui
