#pragma once
#include "engine/core/image.h"

namespace weft {

/// Continues a map beyond what it shows, by two pixels: other programs filter what they look up by
/// the coordinates of the pixels around, and next to a place without any, Blender's Map UV shows
/// another place (27 px away in a test). `st`: H×W×2; `known`: above 0 where it is to be kept. Rows
/// of one direction go on evenly, except over the jump of a texture that repeats. Pure; the same
/// bits everywhere.
void continue_map(ImageF2& st, ViewF1 known);

}  // namespace weft
