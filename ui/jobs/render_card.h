#pragma once
#include "ui/base/ctx.h"

namespace weft::ui {

/// The left part of the Jobs page: settings of a render, its estimate and the button.
void render_card(Ctx& c, ImVec2 size);

}  // namespace weft::ui
