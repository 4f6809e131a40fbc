#pragma once
#include <string>
#include <vector>

#include "app/shot/shot.h"

namespace weft {

/// All existing files that the shot may have been made from, ascending: plates, mattes, holdouts,
/// textures, motion and passes of all frames. Errors: those of listing a folder.
[[nodiscard]] Expected<std::vector<std::string>> input_files(const Shot& shot);

}  // namespace weft
