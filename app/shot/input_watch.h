#pragma once
// Detects inputs that are replaced during a run, which would mix frames from different files.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/shot/fingerprints.h"
#include "engine/core/error.h"

namespace weft {

/// Records the state of each file when the run first relies on it. Thread-safe. Costs one stat and,
/// where they are not known, one pass over the bytes per file; files above kLargestHashed_bytes are
/// compared by size, time and inode only.
class InputWatch {
  public:
    /// `files` spares reading what is known; null: every file is read.
    explicit InputWatch(std::shared_ptr<Fingerprints> files = nullptr);
    ~InputWatch();

    static constexpr std::uint64_t kLargestHashed_bytes = std::uint64_t{256} << 20;

    /// Records the file's size and time, used for a cache key; it may be read later. Missing and
    /// non-regular files are ignored.
    void relied_on(const std::string& path);
    /// Call this before each read. Only the first call for a path is slow.
    void before_read(const std::string& path);
    /// Files that were read and have changed or disappeared since, ascending. Touched or copied
    /// files with the same bytes, or with other permissions, count as unchanged.
    [[nodiscard]] std::vector<std::string> changed() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The error for the files of changed(): Unreadable, naming the first one; success for an empty
/// list.
[[nodiscard]] Status check_unchanged(const std::vector<std::string>& changed);

}  // namespace weft
