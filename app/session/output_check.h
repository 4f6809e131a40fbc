#pragma once
#include <string>

#include "app/session/shot.h"
#include "engine/core/error.h"

namespace weft {

/// Whether a file that is there already is one that the shot is made from on this frame: its plate,
/// a matte, a holdout or a motion file, by whatever path. Errors: Usage, naming it.
[[nodiscard]] Status check_no_input(const Shot& shot, int frame, const std::string& output);

/// Makes the folder that a file is to lie in. Errors: Unreadable, with the folder and the reason.
[[nodiscard]] Status make_output_folder(const std::string& path);

}  // namespace weft
