#pragma once
// The viewer.

#include "ui/ctx.h"

namespace weft::ui {

void viewer(Ctx& c, ImVec2 size);

}  // namespace weft::ui
