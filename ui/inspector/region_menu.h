#pragma once
// Internal: what the right mouse button offers on a region's row.

#include "ui/base/ctx.h"

namespace weft::ui {

/// The menu of the right mouse button on the last item, the region's row.
void region_menu(Ctx& c, const Region& region);
void begin_renaming(Ctx& c, const Region& region);

}  // namespace weft::ui
