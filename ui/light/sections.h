#pragma once
// Internal: parts of the light inspector.

#include "ui/base/ctx.h"

namespace weft::ui {

/// The texture's colour, opacity and blend mode.
void grade_section(Ctx& c, const Region& region);
void keep_section(Ctx& c, const Region& region);
void lamps_controls(Ctx& c, const Region& region);

}  // namespace weft::ui
