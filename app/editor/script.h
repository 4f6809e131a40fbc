#pragma once
// Scripts: lists of steps that drive the editor like a user (docs/USER_GUIDE.md).

#include <functional>
#include <string>

#include "app/editor/editor_app.h"

namespace weft {

/// `frame` draws one frame; `write` writes an image of the last one. An empty path is a script that
/// waits until the picture is final. Errors: Unreadable (no such file, or not a script, with the
/// number of the step), RenderFailed when a step fails (no such widget, or a timeout).
[[nodiscard]] Status run_script(const std::string& path, EditorApp& app,
                                const std::function<void()>& frame,
                                const std::function<Status(const std::string&)>& write);

}  // namespace weft
