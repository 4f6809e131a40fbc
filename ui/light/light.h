#pragma once
// The Seams & Light workspace: its inspector, its tools and the strip of variants.

#include "ui/base/ctx.h"
#include "ui/canvas/view_map.h"

namespace weft::ui {

void light_inspector(Ctx& c);
void strip_panel(Ctx& c, ImVec2 size);
void lamp_tool(Ctx& c, const ViewMap& map, bool hovered);
void keep_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);

}  // namespace weft::ui
