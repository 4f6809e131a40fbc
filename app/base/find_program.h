#pragma once
#include <string>

namespace weft {

/// The file that a command starts: itself if it is a path, else the first of its name in $PATH.
/// Empty: there is none that can be executed.
[[nodiscard]] std::string find_program(const std::string& command);

}  // namespace weft
