#pragma once
// Project files on disk.

#include <string>

#include "app/project/project.h"
#include "engine/core/error.h"
#include "engine/media/atomic_file.h"

namespace weft {

/// Reads a project file; paths stay as they are written in it. Errors: Unreadable (missing, no
/// permission, not a project, of a newer version), with the path. Thread-safe.
[[nodiscard]] Expected<Project> load_project(const std::string& path);

/// Writes it whole or not at all (temporary name, fsync, rename). Errors: NoSpace, Unreadable
/// (folder missing or not writable), Usage (a name that is not UTF-8, the rule), with the path.
[[nodiscard]] Status save_project(const std::string& path, const Project& project,
                                  const WriteRule& rule);

/// For the project that the user opened and changes: replaced, through the link that it was opened
/// by.
[[nodiscard]] WriteRule in_place();

/// The folder against which a project file's relative paths are resolved: its own; "" for the
/// current one.
[[nodiscard]] std::string project_dir(const std::string& project_path);

/// `path` as it is when absolute or empty, else inside `dir` (not normalised, so that ".." behind a
/// symbolic link means what the system means by it).
[[nodiscard]] std::string resolve_path(const std::string& dir, const std::string& path);

/// The project with every path resolved: what a job works with. Never to be saved.
[[nodiscard]] Project resolve_paths(const Project& project, const std::string& dir);

}  // namespace weft
