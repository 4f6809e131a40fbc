#pragma once
// A cache of mattes by name. A background thread reads requested mattes and writes painted ones.

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

using MattePtr = std::shared_ptr<const Matte>;

/// Does not block, except in flush(). Thread-safe.
class MatteShelf {
  public:
    using Reader = std::function<Expected<Matte>()>;

    explicit MatteShelf(std::size_t budget_bytes = std::size_t{256} << 20);
    ~MatteShelf();  ///< Writes all pending mattes.

    /// Returns the matte of this name; null if it is not in memory. Then `read` is called in the
    /// background, unless it failed before. The newest request is served first.
    [[nodiscard]] MattePtr get(const std::string& name, const Reader& read);
    /// Why it could not be read; empty if it was read or not requested.
    [[nodiscard]] std::string error(const std::string& name) const;
    void forget(const std::string& name);

    /// Stores the matte under `path` and writes it there atomically in the background. It stays in
    /// memory until it is written, or permanently if writing fails.
    void write(const std::string& path, MattePtr matte);
    /// Returns the write error since the last call; empty: none.
    [[nodiscard]] std::string take_write_error();
    /// Returns true while a painted matte is not on disk.
    [[nodiscard]] bool writing() const;
    /// The mattes that are not on disk yet, by path.
    [[nodiscard]] std::map<std::string, MattePtr> unwritten() const;
    /// Waits until all mattes are written or have failed.
    void flush();
    /// Increases whenever a matte arrives.
    [[nodiscard]] std::uint64_t changes() const;

  private:
    struct Task {
        std::string name;
        Reader read;     // to read, or
        MattePtr matte;  // to write
    };
    void work();
    /// Removes mattes beyond the memory limit; the caller frees them without the lock.
    [[nodiscard]] std::vector<MattePtr> trim();

    const std::size_t budget_bytes_;
    mutable std::mutex mutex_;
    std::condition_variable wake_, done_;
    std::deque<Task> tasks_;  // writes first, then reads, newest first
    struct Kept {
        MattePtr matte;
        std::uint64_t used = 0;
    };
    std::map<std::string, Kept> kept_;
    std::map<std::string, std::string> errors_;
    std::string reading_;  // the name being read
    std::string write_error_;
    std::size_t bytes_ = 0;
    std::uint64_t clock_ = 0;
    std::atomic<std::uint64_t> changes_ = 0;
    int running_ = 0, to_write_ = 0;
    std::map<std::string, MattePtr> unwritten_;
    bool stop_ = false;
    std::thread thread_;
};

}  // namespace weft
