#pragma once
// Which of some files another program has written.

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace weft {

/// Looks at the stamps of a few files several times a second, in a thread of its own, since files
/// may lie on a network. A file counts as written once its stamp has stayed the same from one look
/// to the next, so that it is not read while it is being saved. Belongs to one thread.
class FileWatch {
  public:
    FileWatch();
    ~FileWatch();
    FileWatch(const FileWatch&) = delete;
    FileWatch& operator=(const FileWatch&) = delete;

    /// The files from now on, by absolute path. Those that were watched before stay known as they
    /// were; the others are known as they are found at once.
    void follow(std::vector<std::string> paths);
    /// The files that were written since the last call.
    [[nodiscard]] std::vector<std::string> take();
    /// Increases with every file that was written.
    [[nodiscard]] std::uint64_t changes() const { return changes_; }

  private:
    void run();

    std::mutex mutex_;
    std::condition_variable wake_;
    std::vector<std::string> wanted_, written_;
    std::uint64_t asked_ = 0;  // calls of follow()
    bool ends_ = false;
    std::atomic<std::uint64_t> changes_{0};
    std::thread thread_;
};

}  // namespace weft
