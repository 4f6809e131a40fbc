#pragma once
// Opening, saving and leaving.

#include "ui/base/ctx.h"

namespace weft::ui {

void file_browser(Ctx& c);
void save_question(Ctx& c);
/// Leaves the document. Asks first if there is unsaved work.
void leave_for(Ctx& c, const LeaveFor& what);
/// The question itself, while it is asked.
void leave_question(Ctx& c);

}  // namespace weft::ui
