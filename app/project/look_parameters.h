#pragma once
#include <vector>

#include "app/project/parameters.h"

namespace weft {

/// The entries of a region's light, grade, layer, finish and lines: how the new surface looks.
[[nodiscard]] std::vector<Parameter<Region>> look_parameters();

}  // namespace weft
