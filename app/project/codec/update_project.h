#pragma once
// Changing a project file that other programs may change at the same time. Every writer takes the
// file's lock, and replaces only what it has read: so nobody's work is lost, also where a program
// takes no lock or the file system has none.

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "app/project/project.h"
#include "engine/core/error.h"
#include "engine/core/file_lock.h"
#include "engine/core/hash.h"

namespace weft {

/// How long a writer waits for the others.
inline constexpr std::chrono::seconds kProjectWait{20};

/// A project as it is on the disk.
struct ProjectOnDisk {
    Project project;
    Hash128 hash;  ///< Of the file's bytes.
};

/// As load_project().
[[nodiscard]] Expected<ProjectOnDisk> read_project(const std::string& path);

/// The hash of what is at `path` now; none: no file. Errors: Unreadable.
[[nodiscard]] Expected<std::optional<Hash128>> project_hash(const std::string& path);

/// The lock that every writer of a project takes before it reads what it will replace. Errors: as
/// FileLock::take().
[[nodiscard]] inline Expected<FileLock> lock_project(const std::string& path) {
    return FileLock::take(path, kProjectWait);
}

/// Writes the project in place, as save_project() does, if the file has the hash `expected` (none:
/// if there is no file) immediately before it is replaced. The caller holds lock_project(). Returns
/// the new hash, or none if the file is another one now; then nothing was written. Errors: those of
/// save_project().
[[nodiscard]] Expected<std::optional<Hash128>> replace_project(
    const std::string& path, const Project& project, const std::optional<Hash128>& expected);

/// Returns the project after the change, or an error, with which nothing is written.
using ProjectEdit = std::function<Expected<Project>(const Project&)>;

/// Loads a project, changes it and saves it, as one step among all writers; returns what was saved.
/// `edit` is called again if a program without the lock changed the file meanwhile. Thread-safe.
/// Errors: those of loading, of `edit` and of saving; Unreadable when others write for longer than
/// `wait`, or a program without the lock again and again.
[[nodiscard]] Expected<Project> update_project(const std::string& path, const ProjectEdit& edit,
                                               std::chrono::milliseconds wait = kProjectWait);

}  // namespace weft
