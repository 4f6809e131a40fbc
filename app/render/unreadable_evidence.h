#pragma once
#include <vector>

#include "app/shot/shot.h"

namespace weft {

/// The frames that are read only to measure light, grain or motion blur, are on no rendered frame's
/// track, and whose plate or matte cannot be read; ascending. Reads all of them.
[[nodiscard]] std::vector<int> unreadable_evidence(const Shot& shot);

}  // namespace weft
