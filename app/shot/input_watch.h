#pragma once
// Notices an input that is replaced while a run goes on: frames before and after would be made
// from different files.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/error.h"

namespace weft {

/// Remembers what each file was when the run first relied on it. Thread-safe. Costs a stat and a
/// pass over the bytes a file; a file above kLargestHashed is told apart by size, time and inode
/// alone.
class InputWatch {
  public:
    InputWatch();
    ~InputWatch();

    static constexpr std::int64_t kLargestHashed = 256ll << 20;

    /// The file's size and time have been relied on (a cache was chosen by them); it may be read
    /// later. What is not there or no regular file is not watched.
    void relied_on(const std::string& path);
    /// To be called before each read. Only the first one of a path costs more than a look-up.
    void before_read(const std::string& path);
    /// Files that were read and are not what they were, or are gone, ascending. A file that was
    /// touched, copied over or given other rights is the same while its bytes are.
    [[nodiscard]] std::vector<std::string> changed() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The error for what changed(), none for an empty list: Unreadable, naming the first file.
[[nodiscard]] Status check_unchanged(const std::vector<std::string>& changed);

}  // namespace weft
