#pragma once
// Internal: the two ways to run the editor.

#include "app/editor/editor.h"

namespace weft {

[[nodiscard]] Expected<int> run_window(const EditorOptions& options);
[[nodiscard]] Expected<int> run_offscreen(const EditorOptions& options);

}  // namespace weft
