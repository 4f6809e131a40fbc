#pragma once
// The Mask workspace: its inspector, and the tools that draw mattes.

#include "ui/base/ctx.h"
#include "ui/canvas/view_map.h"

namespace weft::ui {

void mask_inspector(Ctx& c);
/// Suggested keyframes; `mattes_only`: those of the matte only.
void hints_section(Ctx& c, bool mattes_only);
/// Why there are none.
[[nodiscard]] std::string no_hints_text(const SessionView& view);
void motion_zones_section(Ctx& c, const Region& region);

/// Handles brush input before drawing, so that this frame shows the stroke.
void brush_input(Ctx& c, const ViewMap& map, bool active);
/// Draws the brush's outline; changes its size.
void brush_tool(Ctx& c, const ViewMap& map, bool hovered);
void lasso_tool(Ctx& c, const ViewMap& map, bool active);
void polygon_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);
void shape_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);
void scribble_tool(Ctx& c, const ViewMap& map, bool active);

}  // namespace weft::ui
