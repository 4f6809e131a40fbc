#pragma once
// The Review workspace.

#include "ui/base/ctx.h"

namespace weft::ui {

void review_panel(Ctx& c, ImVec2 size);
void review_inspector(Ctx& c);

}  // namespace weft::ui
