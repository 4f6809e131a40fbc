#pragma once
// The viewer.

#include "ui/base/ctx.h"

namespace weft::ui {

void viewer(Ctx& c, ImVec2 size);

}  // namespace weft::ui
