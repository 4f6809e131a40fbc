#pragma once
#include <string>

#include "engine/core/error.h"
#include "engine/core/geometry.h"

namespace weft {

/// Distance between repeats of a sample of bricks or tiles, along the axis that is closer to the
/// direction, px. Slow: it reads the file. Errors: those of reading, Usage (nothing repeats).
[[nodiscard]] Expected<double> texture_pitch(const std::string& path, Vec2 along);

}  // namespace weft
