#pragma once
// The timeline, and the keys area below it.

#include "ui/base/ctx.h"

namespace weft::ui {

void timeline(Ctx& c, ImVec2 size);
/// Rows of keys, or curves, of the selected region.
void keys_panel(Ctx& c, ImVec2 size);
/// The keys of the keyboard that belong to it while it has the focus. Returns true if one was used.
bool keys_area_shortcut(Ctx& c);

}  // namespace weft::ui
