#pragma once
#include <string>
#include <vector>

#include "app/shot/shot.h"

namespace weft {

/// Every file that the shot may have been made from and that is there, ascending: plates, mattes,
/// holdouts, textures, motion and passes of all frames. Errors: those of listing a folder.
[[nodiscard]] Expected<std::vector<std::string>> input_files(const Shot& shot);

}  // namespace weft
