#pragma once
// The bars around the panels, and the page without a shot.

#include "ui/base/ctx.h"

namespace weft::ui {

void top_bar(Ctx& c, ImVec2 size);
void status_bar(Ctx& c, ImVec2 size);
void tool_strip(Ctx& c, ImVec2 size);
void welcome(Ctx& c, ImVec2 size);

}  // namespace weft::ui
