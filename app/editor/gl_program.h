#pragma once
// Shader programs.

#include <string>

namespace weft {

/// Compiles and links a program. Needs a current OpenGL context. Returns 0 on failure and adds the
/// driver's message to `log`.
[[nodiscard]] unsigned link_program(const char* vertex, const char* fragment, std::string& log);

}  // namespace weft
