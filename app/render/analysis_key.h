#pragma once
#include <string>

#include "app/shot/shot.h"

namespace weft {

/// A key of everything that the analysis of a region depends on, 32 hexadecimal digits. `index`:
/// into ShotPlan::regions. `painted`: mattes without a file. Errors: those of listing the matte and
/// motion files.
[[nodiscard]] Expected<std::string> region_key(const Shot& shot, std::size_t index,
                                               const PaintedMattes& painted);

}  // namespace weft
