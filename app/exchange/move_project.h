#pragma once
// Saving an open project under another name: what belongs to it goes along.

#include <map>
#include <string>

#include "app/project/project.h"
#include "engine/core/error.h"

namespace weft {

/// The new places of copied files, relative to the new project, by their old absolute paths.
using MovedFiles = std::map<std::string, std::string>;

/// Returns `path` relative to `dir` if it lies below it, otherwise unchanged, so that a project's
/// folder can be moved.
[[nodiscard]] std::string relative_to(const std::string& dir, const std::string& path);

/// Where a project writes after it has been saved as `to` instead of `from`, so that the two never
/// share a folder of results: below the new project, with its name. All paths absolute. With an
/// empty `from`, before the first save, the output stays as it was chosen.
[[nodiscard]] std::string moved_output(const std::string& output, const std::string& from,
                                       const std::string& to);

/// Paths of a state of the project `from` (absolute, or empty before the first save) as the project
/// `to` names them.
[[nodiscard]] Project rebased(const Project& project, const std::string& from,
                              const std::string& to, const MovedFiles& moved);

/// Copies the mattes and textures of the project `from` (those in NAME_mattes and NAME_textures
/// beside it, and those below `unsaved`) beside `to`. Files that are missing are left out. Errors:
/// those of copying.
[[nodiscard]] Expected<MovedFiles> copy_own_files(const Project& project, const std::string& from,
                                                  const std::string& to,
                                                  const std::string& unsaved);

}  // namespace weft
