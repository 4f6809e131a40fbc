#pragma once
// A project keeps the pixels of the textures that it takes from a library, so that it opens
// anywhere, with or without that library.

#include <string>

#include "app/project/project.h"
#include "engine/media/write_rule.h"

namespace weft {

/// Where the textures of the project file `project_path` are kept: "shot_textures" beside
/// "shot.weft".
[[nodiscard]] std::string kept_textures_name(const std::string& project_path);

/// Writes every texture that is named "db:ID" into `folder`, with its credit beside it, and names
/// the file in its stead: `named`/db_ID.png. `library` empty: the user's own. Errors: Refused (with
/// nothing written) when the project excludes the licence of one; Usage and Unreadable as
/// resolve_texture(); NoSpace.
[[nodiscard]] Expected<Project> keep_library_textures(const Project& project,
                                                      const std::string& folder,
                                                      const std::string& named,
                                                      const std::string& library,
                                                      const WriteRule& rule = WriteRule::own());
/// The same for a project file, with relative names.
[[nodiscard]] Expected<Project> keep_library_textures(const Project& project,
                                                      const std::string& project_path,
                                                      const std::string& library,
                                                      const WriteRule& rule = WriteRule::own());

}  // namespace weft
