#pragma once
// An advisory lock for files that are replaced by renaming: one writer at a time loads, changes and
// replaces the file. The kernel's lock on the file itself, so nothing is left behind, and the lock
// of a process that crashes goes with it.

#include <chrono>
#include <string>

#include "engine/core/error.h"

namespace weft {

/// Held until it is destroyed. Belongs to one thread; two locks of one process exclude each other
/// as those of two processes do.
class FileLock {
  public:
    /// Waits at most `wait` for the lock of the file at `path` (a symbolic link is followed). A
    /// writer that replaced the file meanwhile is noticed: the lock is that of the file which the
    /// path names afterwards. Without an existing regular file, without permission to read it, and
    /// on file systems without locks, nobody is excluded; held() tells. Errors: Unreadable (another
    /// program holds the lock for longer than `wait`).
    [[nodiscard]] static Expected<FileLock> take(const std::string& path,
                                                 std::chrono::milliseconds wait);
    FileLock(FileLock&& other) noexcept;
    FileLock& operator=(FileLock&&) = delete;
    ~FileLock();

    /// Whether others are excluded.
    [[nodiscard]] bool held() const { return file_ >= 0; }

  private:
    explicit FileLock(int file) : file_(file) {}
    int file_;  // −1: none
};

}  // namespace weft
