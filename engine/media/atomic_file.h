#pragma once
// All files are written through these functions. A file appears whole or not at all: it is written
// under a temporary name in the same folder, flushed to the disk and renamed, and only if the
// WriteRule allows it (engine/media/write_rule.h). The rule is checked before anything is written
// and again before the rename. tests/architecture/writers_test.cpp forbids other ways.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/error.h"
#include "engine/media/write_rule.h"

namespace weft {

/// Writes `bytes` to `path`. Errors: Usage (by the rule: an existing file, an input, a path outside
/// the root, a device), NoSpace (disk full, quota, file size limit), Unreadable (folder missing or
/// not writable, `path` is a folder). After an error an older file at `path` is unchanged and no
/// temporary remains. Several threads may write to different paths.
[[nodiscard]] Status write_file_atomically(const std::string& path,
                                           std::span<const std::byte> bytes, const WriteRule& rule);
[[nodiscard]] Status write_file_atomically(const std::string& path, std::string_view text,
                                           const WriteRule& rule);
/// Copies the bytes of another file. Errors: the same.
[[nodiscard]] Status copy_file_atomically(const std::string& from, const std::string& to,
                                          const WriteRule& rule);

/// Returns true if the path names an open descriptor (/dev/stdout, /dev/fd/3), a pipe or another
/// device.
[[nodiscard]] bool is_device(const std::string& path);

/// Checks before the work whether a file could be written there. A missing folder is no error: it
/// is to be created with make_folder_of() when the file is written. Errors: the same.
[[nodiscard]] Status check_output(const std::string& path, const WriteRule& rule);

/// Creates a folder, or the folder of a file, with its parents. Errors: Usage (outside the root),
/// Unreadable, with the reason.
[[nodiscard]] Status make_folder(const std::string& folder, const WriteRule& rule);
[[nodiscard]] Status make_folder_of(const std::string& path, const WriteRule& rule);

/// A temporary file beside `path`, for a library that writes by name (a movie container). Its name
/// is hidden, contains host and process, and keeps the extension. Deleted on destruction.
class TemporaryFile {
  public:
    /// Creates the empty file, so that an unwritable folder is detected before any work. Errors: as
    /// write_file_atomically().
    [[nodiscard]] static Expected<TemporaryFile> create(const std::string& path,
                                                        const WriteRule& rule);
    TemporaryFile(TemporaryFile&& other) noexcept;
    TemporaryFile& operator=(TemporaryFile&&) = delete;
    ~TemporaryFile();

    [[nodiscard]] std::string name() const;
    /// Replaces the content of the temporary file.
    [[nodiscard]] Status write(std::span<const std::byte> bytes);
    /// For a library that failed without a reason: the disk's error, if it is full. Destroys the
    /// content. Errors: NoSpace, Unreadable.
    [[nodiscard]] Status check_disk() const;
    /// Flushes the file to the disk and gives it its final name.
    [[nodiscard]] Status commit();
    /// The two steps of commit(), for a caller that looks at the file it replaces in between.
    [[nodiscard]] Status flush() const;
    /// Alone for caches, which have a checksum and may be lost.
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

/// A private folder below the system's temporary folder (TMPDIR). Removed with its content on
/// destruction; folders of killed processes of this host are removed when the next one is created.
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

/// Removes every temporary file and folder of this process and prevents new ones: for a process
/// that is about to call _exit(). A thread that requests one afterwards blocks forever.
void abandon_temporaries();

/// Removes what killed runs left in the folder of `path`: temporaries of processes of this host
/// that have ended, and any older than a day.
void remove_stale_temporaries(const std::string& path);

/// The error for a system call that failed on `path`: `doing` as in "cannot be written".
[[nodiscard]] Error system_error(const std::string& path, std::string_view doing, int error_number);

}  // namespace weft
