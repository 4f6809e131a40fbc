#pragma once
// Files that appear whole or not at all: written under a temporary name in the same folder, flushed
// to the disk, then renamed.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/error.h"

namespace weft {

/// Replaces the file at `path` by `bytes`. A symbolic link is followed; a device or a pipe
/// (/dev/stdout) is written to directly. Errors: NoSpace (disk full, quota, file size limit),
/// Unreadable (folder missing or not writable, `path` is a folder). On error an older file at
/// `path` is untouched and no temporary remains. Several threads may write, each its own path.
[[nodiscard]] Status write_file_atomically(const std::string& path,
                                           std::span<const std::byte> bytes);
[[nodiscard]] Status write_file_atomically(const std::string& path, std::string_view text);

/// A temporary name beside `path` for a library that writes by name (a movie container). The name
/// is hidden, carries the host and process, and keeps the extension. Discarded on destruction.
class TemporaryFile {
  public:
    /// Creates the empty file, so that an unwritable folder is known before any work is done.
    /// Errors as write_file_atomically().
    [[nodiscard]] static Expected<TemporaryFile> create(const std::string& path);
    TemporaryFile(TemporaryFile&& other) noexcept;
    TemporaryFile& operator=(TemporaryFile&&) = delete;
    ~TemporaryFile();

    [[nodiscard]] const std::string& name() const { return name_; }
    /// Flushes the file to the disk and gives it its final name.
    [[nodiscard]] Status commit();
    /// The same without the flush: for caches, which carry a checksum and may be lost.
    [[nodiscard]] Status commit_unflushed();

  private:
    TemporaryFile(std::string name, std::string target);
    std::string name_, target_;  // name_ is empty once committed or moved from
};

/// A private folder below the system's temporary one (TMPDIR). Removed with all it holds on
/// destruction; those of killed processes of this host go when the next one is made.
class TemporaryFolder {
  public:
    /// Errors: NoSpace when no folder can be made.
    [[nodiscard]] static Expected<TemporaryFolder> create();
    TemporaryFolder(TemporaryFolder&& other) noexcept;
    TemporaryFolder& operator=(TemporaryFolder&&) = delete;
    ~TemporaryFolder();
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    explicit TemporaryFolder(std::string path);
    std::string path_;  // empty once moved from
};

/// Removes every temporary file and folder of this process and lets no thread begin another: for a
/// process that is about to _exit(). A thread that asks for one afterwards waits for ever.
void abandon_temporaries();

/// Removes what a killed run may have left: temporaries in the folder of `path` that nobody writes
/// any more, that is those of a process of this host that has ended, and any older than a day.
void remove_stale_temporaries(const std::string& path);

/// The error for a system call that failed on `path`: `doing` as in "cannot be written".
[[nodiscard]] Error system_error(const std::string& path, std::string_view doing, int error_number);

}  // namespace weft
