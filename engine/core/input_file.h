#pragma once
// The one way in which files are opened for reading. A path that a user, a project or a job file
// names may lead to a pipe, a device or a folder: opening one of those may wait for ever, and
// reading one may never end. So every reader asks here first (tests/architecture enforces it).

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/hash.h"

namespace weft {

inline constexpr std::uint64_t kNoFileLimit = UINT64_MAX;
/// For text that a person or a program wrote: projects, tracks, jobs, scripts, manifests.
inline constexpr std::uint64_t kTextFileLimit_bytes = std::uint64_t{32} << 20;

/// What tells, without reading it, whether a file is still the same.
struct FileStamp {
    std::uint64_t bytes = 0;
    std::int64_t modified_ns = 0;  ///< Since the epoch; programs that copy files may set it.
    /// When bytes, name, time or rights last changed. Only the system sets it.
    std::int64_t changed_ns = 0;
    std::uint64_t device = 0, inode = 0;
    bool operator==(const FileStamp&) const = default;
};

/// The stamp of a regular file (a link to one counts), which is not opened; nothing for all else.
/// Thread-safe.
[[nodiscard]] std::optional<FileStamp> stamp_of(const std::string& path);

/// Says that `path` is a regular file (a link to one counts) that may be read, for libraries which
/// open files by name. `what` begins the message: "The track", "The plate frame"; empty: the path
/// alone. Never waits, whatever the path leads to. Thread-safe. Errors: Unreadable (missing, a
/// folder, pipe, socket or device, no permission, larger than the limit).
[[nodiscard]] Expected<FileStamp> check_input_file(const std::string& path,
                                                   std::string_view what = {},
                                                   std::uint64_t limit_bytes = kNoFileLimit);

/// The whole contents. Reads at most `limit_bytes` and one more, whatever the file says of its
/// size. Thread-safe. Errors: as check_input_file(); NoSpace when it does not fit into memory.
[[nodiscard]] Expected<std::string> read_file(const std::string& path, std::string_view what,
                                              std::uint64_t limit_bytes = kTextFileLimit_bytes);

/// The same of standard input, which may be a pipe.
[[nodiscard]] Expected<std::string> read_standard_input(
    std::string_view what, std::uint64_t limit_bytes = kTextFileLimit_bytes);

/// The hash of the whole contents. Thread-safe. Errors: as check_input_file().
[[nodiscard]] Expected<Hash128> hash_of_contents(const std::string& path,
                                                 std::string_view what = {});

/// An open file for readers that take parts of it. Closed with the object. read_at() may be called
/// from several threads.
class InputFile {
  public:
    /// Errors: as check_input_file().
    [[nodiscard]] static Expected<InputFile> open(const std::string& path,
                                                  std::string_view what = {},
                                                  std::uint64_t limit_bytes = kNoFileLimit);
    InputFile(InputFile&& other) noexcept;
    InputFile& operator=(InputFile&& other) noexcept;
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    ~InputFile();

    /// As it was when the file was opened.
    [[nodiscard]] const FileStamp& stamp() const { return stamp_; }
    [[nodiscard]] std::uint64_t bytes() const { return stamp_.bytes; }
    /// How many bytes were read into `to`: fewer than `count` at the end of the file. Errors:
    /// Unreadable (the disk).
    [[nodiscard]] Expected<std::size_t> read_at(std::uint64_t offset, void* to,
                                                std::size_t count) const;

  private:
    InputFile(int descriptor, std::string name, const FileStamp& stamp)
        : descriptor_(descriptor), name_(std::move(name)), stamp_(stamp) {}
    int descriptor_;
    std::string name_;  // as messages begin
    FileStamp stamp_;
};

}  // namespace weft
