#pragma once
#include <vector>

#include "app/project/parameters.h"

namespace weft {

/// The entries of a region's matte; matte_parameters() has the same for other mattes.
[[nodiscard]] std::vector<Parameter<Region>> region_matte_parameters();

}  // namespace weft
