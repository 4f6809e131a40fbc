#pragma once
// Internal: the units of the families' patterns, from the parameters with which they are drawn. The
// kinds are those of each family.

#include "texture_db/starter/starter.h"

namespace weft::starter {

[[nodiscard]] StarterUnit brick_unit(int kind, float w, float h);
[[nodiscard]] StarterUnit tile_unit(int kind, float size, bool checkered);
[[nodiscard]] StarterUnit wallpaper_unit(int kind, float w, float h);
[[nodiscard]] StarterUnit roof_unit(int kind, float w, float h);
/// In stitches of w × h.
[[nodiscard]] StarterUnit knit_unit(int stitches, int rows, float w, float h);
/// Of stripes that repeat every `step` px along a turned cloth, across it or both ways.
[[nodiscard]] StarterUnit cloth_unit(float step, float turn, bool both_ways);

}  // namespace weft::starter
