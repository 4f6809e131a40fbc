#pragma once
// What the editor remembers of the projects that were open lately.

#include <string>

#include "app/base/editor_settings.h"

namespace weft {

/// Puts a project file first among the recent ones; forgets what was remembered of those that fall
/// out.
void remember_recent(EditorSettings& settings, const std::string& path);

/// The range that is marked in a project; none for one without a file.
[[nodiscard]] MarkedRange marked_range(const EditorSettings& settings, const std::string& path);
void remember_marked_range(EditorSettings& settings, const std::string& path,
                           const MarkedRange& range);

}  // namespace weft
