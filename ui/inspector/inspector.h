#pragma once
// The inspector: the list of regions, then the workspace's sections.

#include "ui/base/ctx.h"

namespace weft::ui {

void inspector(Ctx& c, ImVec2 size);

}  // namespace weft::ui
