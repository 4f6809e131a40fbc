#pragma once
// What the editor remembers of the projects that were open lately.

#include <string>

#include "app/base/editor_settings.h"

namespace weft {

/// Puts a project file first among the recent ones; forgets what was remembered of those that fall
/// out.
void remember_recent(EditorSettings& settings, const std::string& path);

/// Where a project was left; nowhere for one without a file.
[[nodiscard]] ProjectPlace place_left(const EditorSettings& settings, const std::string& path);
void remember_place(EditorSettings& settings, const std::string& path, const ProjectPlace& place);

}  // namespace weft
