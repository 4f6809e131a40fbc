#pragma once
// Shader programs.

#include <string>

namespace weft {

/// Needs a current OpenGL context. 0 when it does not compile; the driver's words are added to
/// `log`.
[[nodiscard]] unsigned link_program(const char* vertex, const char* fragment, std::string& log);

}  // namespace weft
