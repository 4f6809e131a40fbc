#pragma once
// The Jobs page.

#include "ui/base/ctx.h"

namespace weft::ui {

void jobs_page(Ctx& c, ImVec2 size);

}  // namespace weft::ui
