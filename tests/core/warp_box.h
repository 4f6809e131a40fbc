#pragma once
// The plane that the tests of warps bend.

#include "engine/core/quad.h"

namespace weft {

inline const Quad<double> kBox{glm::dvec2(100, 50), glm::dvec2(400, 50), glm::dvec2(400, 250),
                               glm::dvec2(100, 250)};

}  // namespace weft
