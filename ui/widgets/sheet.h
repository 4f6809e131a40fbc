#pragma once
// A centred dialog above everything else.

#include "ui/base/ctx.h"

namespace weft::ui {

/// Its button or Esc sets `open` to false. Always call end_sheet().
bool begin_sheet(Ctx& c, const char* title, ImVec2 size, bool& open);
void end_sheet(Ctx& c);

}  // namespace weft::ui
