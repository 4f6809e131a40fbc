#pragma once
// Mattes in memory, by name: read by a background thread when they are asked for, written by it
// when they are painted.

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

/// Never blocks its caller, save in flush(). Thread-safe.
class MatteShelf {
  public:
    using Reader = std::function<Expected<Matte>()>;

    explicit MatteShelf(std::size_t budget_bytes = std::size_t{256} << 20);
    ~MatteShelf();  ///< Writes what is left to write.

    /// The matte of this name; null when it is not there, and then `read` is called in the
    /// background, unless that has failed before. The newest request is served first.
    [[nodiscard]] MattePtr get(const std::string& name, const Reader& read);
    /// Why it could not be read; empty when it could, or has not been tried.
    [[nodiscard]] std::string error(const std::string& name) const;
    void forget(const std::string& name);

    /// Keeps the matte under `path` and writes it there in the background, whole or not at all. It
    /// stays in memory until it is written, and for good where that fails.
    void write(const std::string& path, MattePtr matte);
    /// What went wrong with writing since the last call; empty: nothing.
    [[nodiscard]] std::string take_write_error();
    /// Whether a painted matte is not on the disk yet.
    [[nodiscard]] bool writing() const;
    /// Those that are not on the disk, by path.
    [[nodiscard]] std::map<std::string, MattePtr> unwritten() const;
    /// Waits until everything is on the disk, or has failed.
    void flush();
    /// Grows whenever a matte arrives.
    [[nodiscard]] std::uint64_t arrivals() const;

  private:
    struct Task {
        std::string name;
        Reader read;     // to read, or
        MattePtr matte;  // to write
    };
    void work();
    /// What has to go, to be freed without the lock.
    [[nodiscard]] std::vector<MattePtr> trim();

    const std::size_t budget_bytes_;
    mutable std::mutex mutex_;
    std::condition_variable wake_, done_;
    std::deque<Task> tasks_;  // writing first, then reading from the newest
    struct Kept {
        MattePtr matte;
        std::uint64_t used = 0;
    };
    std::map<std::string, Kept> kept_;
    std::map<std::string, std::string> errors_;
    std::string reading_;  // the name in flight
    std::string write_error_;
    std::size_t bytes_ = 0;
    std::uint64_t clock_ = 0;
    std::atomic<std::uint64_t> arrivals_ = 0;
    int running_ = 0, to_write_ = 0;
    std::map<std::string, MattePtr> unwritten_;
    bool stop_ = false;
    std::thread thread_;
};

}  // namespace weft
