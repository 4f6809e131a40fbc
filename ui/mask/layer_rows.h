#pragma once
// Rows of a region's painted layers: its holdouts and zones.

#include "ui/base/ctx.h"

namespace weft::ui {

/// A row that selects a holdout or zone for painting, and removes it.
void layer_row(Ctx& c, const Region& region, int layer);
/// A button that adds one: what is painted next goes to `begin`.
void begin_layer(Ctx& c, const char* label, const char* tip, SelectMatteLayer begin);
void back_to_matte(Ctx& c);

}  // namespace weft::ui
