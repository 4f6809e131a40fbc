#pragma once
// The one door through which files are written. A file appears whole or not at all: written under a
// temporary name in the same folder, flushed to the disk, then renamed; and only where the
// WriteRule lets it (engine/media/write_rule.h). The rule is asked before anything is written and
// again when the file gets its name. tests/architecture/writers_test.cpp holds every other source
// to this.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/error.h"
#include "engine/media/write_rule.h"

namespace weft {

/// Writes `bytes` to `path`. Errors: Usage (the rule: a file that is there, an input, a place
/// outside of the root, a device), NoSpace (disk full, quota, file size limit), Unreadable (folder
/// missing or not writable, `path` is a folder). On error an older file at `path` is untouched and
/// no temporary remains. Several threads may write, each its own path.
[[nodiscard]] Status write_file_atomically(const std::string& path,
                                           std::span<const std::byte> bytes, const WriteRule& rule);
[[nodiscard]] Status write_file_atomically(const std::string& path, std::string_view text,
                                           const WriteRule& rule);
/// The bytes of another file. Errors: the same.
[[nodiscard]] Status copy_file_atomically(const std::string& from, const std::string& to,
                                          const WriteRule& rule);

/// Whether the path names an open descriptor (/dev/stdout, /dev/fd/3), a pipe or another device.
[[nodiscard]] bool is_device(const std::string& path);

/// Whether a file could be written there now, so that it is known before the work. Errors: the
/// same.
[[nodiscard]] Status check_output(const std::string& path, const WriteRule& rule);

/// Makes a folder, or the one of a file, with all above it. Errors: Usage (outside of the root),
/// Unreadable, with the reason.
[[nodiscard]] Status make_folder(const std::string& folder, const WriteRule& rule);
[[nodiscard]] Status make_folder_of(const std::string& path, const WriteRule& rule);

/// A temporary name beside `path` for a library that writes by name (a movie container). The name
/// is hidden, carries the host and process, and keeps the extension. Discarded on destruction.
class TemporaryFile {
  public:
    /// Creates the empty file, so that an unwritable folder is known before any work is done.
    /// Errors as write_file_atomically().
    [[nodiscard]] static Expected<TemporaryFile> create(const std::string& path,
                                                        const WriteRule& rule);
    TemporaryFile(TemporaryFile&& other) noexcept;
    TemporaryFile& operator=(TemporaryFile&&) = delete;
    ~TemporaryFile();

    [[nodiscard]] std::string name() const;
    /// Replaces what the temporary holds.
    [[nodiscard]] Status write(std::span<const std::byte> bytes);
    /// For a library that failed without a reason: the disk's, when it takes no more. Spoils the
    /// file. Errors: NoSpace, Unreadable.
    [[nodiscard]] Status check_disk() const;
    /// Flushes the file to the disk and gives it its final name.
    [[nodiscard]] Status commit();
    /// The same without the flush: for caches, which carry a checksum and may be lost.
    [[nodiscard]] Status commit_unflushed();

  private:
    struct Place {
        std::string shown;        // the path as the caller wrote it
        std::string real_folder;  // absolute, without symbolic links
        std::string file, temporary;
        WriteRule rule;
        int folder = -1;  // the folder, kept open
    };
    explicit TemporaryFile(Place place);
    [[nodiscard]] Status check() const;
    [[nodiscard]] Expected<int> open(int flags) const;

    Place place_;  // folder is -1 once moved from
    bool committed_ = false;
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
