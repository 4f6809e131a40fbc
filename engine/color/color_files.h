#pragma once
#include <string>
#include <vector>

#include "engine/color/color_space.h"

namespace weft {

/// The files that conversions between any two of `spaces`, and between them and the built-in ones,
/// are read from, ascending: the config of $OCIO and its look-up tables. Empty if all are built in.
[[nodiscard]] std::vector<std::string> color_files(const std::vector<ColorSpace>& spaces);

}  // namespace weft
