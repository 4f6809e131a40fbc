#pragma once
#include <vector>

#include "app/shot/shot.h"

namespace weft {

/// The frames that no rendered frame is followed through, that are read only to measure light,
/// grain or motion blur, and whose plate or matte cannot be read; ascending. Reads them all.
[[nodiscard]] std::vector<int> unreadable_evidence(const Shot& shot);

}  // namespace weft
