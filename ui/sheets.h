#pragma once
// A window in the middle of the screen, above everything else.

#include "ui/ctx.h"

namespace weft::ui {

/// Closed by its cross or Esc, which set `open` to false. end_sheet() belongs to every call.
bool begin_sheet(Ctx& c, const char* title, ImVec2 size, bool& open);
void end_sheet(Ctx& c);

}  // namespace weft::ui
