#pragma once
#include <vector>

#include "app/project/project.h"

namespace weft {

/// Chooses the channel of each of the region's matte sequences for which none is set, once for all
/// of the `frames` that have a file, so that no frame is read by another channel than the rest.
void choose_matte_channels(Region& region, const std::vector<int>& frames);

}  // namespace weft
