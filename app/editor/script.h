#pragma once
// Scripts: a list of steps that drive the editor as a hand would (docs/USER_GUIDE.md names them).

#include <functional>
#include <string>

#include "app/editor/editor_app.h"

namespace weft {

/// `frame` draws one frame, `write` writes the picture of the last one. An empty path is a script
/// that waits until the picture has come to rest. Errors: Unreadable (no such file, not a script,
/// with the number of the step), RenderFailed when a step cannot be done (no such widget, nothing
/// came in time).
[[nodiscard]] Status run_script(const std::string& path, EditorApp& app,
                                const std::function<void()>& frame,
                                const std::function<Status(const std::string&)>& write);

}  // namespace weft
