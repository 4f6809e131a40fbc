#pragma once
// Project files on disk.

#include <string>

#include "app/project/project.h"
#include "engine/core/error.h"
#include "engine/media/atomic_file.h"

namespace weft {

/// Reads a project file; paths are not resolved. Errors: Unreadable with the path (missing, no
/// permission, not a project, or a newer version). Thread-safe.
[[nodiscard]] Expected<Project> load_project(const std::string& path);

/// Writes a project file atomically (temporary name, fsync, rename): a new one, or a file of this
/// program alone. A project that is changed goes through update_project.h. Errors, with the path:
/// NoSpace; Unreadable (folder missing or not writable); Usage (a name that is not UTF-8, or the
/// write rule).
[[nodiscard]] Status save_project(const std::string& path, const Project& project,
                                  const WriteRule& rule);

/// The write rule for the project that the user opened: it is replaced, also through a symbolic
/// link.
[[nodiscard]] WriteRule in_place();

/// The folder that a project file's relative paths refer to: its own; "" for the current folder.
[[nodiscard]] std::string project_dir(const std::string& project_path);

/// Returns `path` if it is absolute or empty, otherwise `path` inside `dir`. It is not normalised,
/// so that ".." behind a symbolic link means the same as for the system.
[[nodiscard]] std::string resolve_path(const std::string& dir, const std::string& path);

/// Returns the project with all paths resolved, for jobs. Do not save it.
[[nodiscard]] Project resolve_paths(const Project& project, const std::string& dir);

}  // namespace weft
