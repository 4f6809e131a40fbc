#pragma once
// Copies library textures beside the project, so that the project opens without the library.

#include <string>

#include "app/project/project.h"
#include "engine/media/write_rule.h"

namespace weft {

/// Folder for the textures of the project file `project_path`: "shot_textures" beside "shot.weft".
[[nodiscard]] std::string kept_textures_name(const std::string& project_path);

/// Writes every texture named "db:ID" to `folder` with its credit, and replaces the name by the
/// file: `named`/db_ID.png. `library` empty: the user's own. Errors: Refused, with nothing written,
/// when the project excludes a texture's licence; Usage and Unreadable as resolve_texture();
/// NoSpace.
[[nodiscard]] Expected<Project> keep_library_textures(const Project& project,
                                                      const std::string& folder,
                                                      const std::string& named,
                                                      const std::string& library,
                                                      const WriteRule& rule = WriteRule::own());
/// The same for a project file; the names are relative to it.
[[nodiscard]] Expected<Project> keep_library_textures(const Project& project,
                                                      const std::string& project_path,
                                                      const std::string& library,
                                                      const WriteRule& rule = WriteRule::own());

}  // namespace weft
