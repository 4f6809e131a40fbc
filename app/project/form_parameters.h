#pragma once
#include <vector>

#include "app/project/parameters.h"

namespace weft {

/// The entries of a region's form: what shows the shape of the surface, and how far it is followed.
[[nodiscard]] std::vector<Parameter<Region>> form_parameters();

}  // namespace weft
