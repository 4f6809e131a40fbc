#pragma once
// The Texture workspace: its inspector, the drawer, and how textures are found and added.

#include "ui/base/ctx.h"
#include "ui/canvas/view_map.h"

namespace weft::ui {

void texture_inspector(Ctx& c);
void texture_drawer(Ctx& c, ImVec2 size);
/// The window for adding a folder of textures: import it, or browse it only.
void adding_window(Ctx& c);
void similar_tool(Ctx& c, const ViewMap& map, bool active);

}  // namespace weft::ui
