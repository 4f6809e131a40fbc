#pragma once
#include <vector>

#include "engine/lighting/shading.h"

namespace weft {

/// The shading at the plate pixels [x0, x0 + out.size()) of row y, bilinear between the small
/// picture's pixel centres. `scratch` may hold anything.
void shading_row(const Shading& shading, int x0, int y, std::vector<float>& scratch,
                 std::vector<float>& out);

}  // namespace weft
