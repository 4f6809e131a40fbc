#pragma once
// Internal: parts of the mask inspector.

#include "ui/base/ctx.h"

namespace weft::ui {

void propagation_section(Ctx& c, const Region& region);
void holdouts_section(Ctx& c, const Region& region);
void light_zones_section(Ctx& c, const Region& region);
/// Size, hardness and opacity of the brush.
void brush_rows(Ctx& c);
void shape_controls(Ctx& c);

}  // namespace weft::ui
