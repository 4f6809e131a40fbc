#include "engine/core/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <thread>
#include <utility>

#include "engine/core/stopwatch.h"

namespace weft {
namespace {

constexpr auto kPause = std::chrono::milliseconds(10);

/// An open file that is closed, without touching its lock, at the end.
struct Descriptor {
    explicit Descriptor(int number) : file(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (file >= 0) ::close(file);
    }
    int file;
};

// −1 unless the path leads to a regular file. Network file systems lock exclusively only what is
// open for writing.
int open_file(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return -1;
    constexpr int kFlags = O_NONBLOCK | O_CLOEXEC | O_NOCTTY;
    const int file = ::open(path.c_str(), O_RDWR | kFlags);
    return file >= 0 ? file : ::open(path.c_str(), O_RDONLY | kFlags);
}

// Opened once more, because network file systems look a name up anew only then.
bool is_still_named(const std::string& path, int file) {
    const Descriptor now(open_file(path));
    struct stat ours {
    }, named{};
    return now.file >= 0 && ::fstat(file, &ours) == 0 && ::fstat(now.file, &named) == 0 &&
           ours.st_dev == named.st_dev && ours.st_ino == named.st_ino;
}

tl::unexpected<Error> held_too_long(const std::string& path, std::chrono::milliseconds wait) {
    const auto seconds = std::chrono::ceil<std::chrono::seconds>(wait).count();
    return fail(ErrorCode::kUnreadable,
                path + " is being written by another program, for more than " +
                    std::to_string(seconds) + " s.",
                "Wait until that is done and try again; 'fuser " + path +
                    "' lists the programs that have it open.");
}

}  // namespace

Expected<FileLock> FileLock::take(const std::string& path, std::chrono::milliseconds wait) {
    const auto end = Clock::now() + wait;
    for (;;) {
        FileLock lock(open_file(path));
        if (!lock.held()) return lock;
        const int error = ::flock(lock.file_, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
        if (error == 0 && is_still_named(path, lock.file_)) return lock;
        // ESTALE: replaced on another machine.
        const bool again = error == 0 || error == EWOULDBLOCK || error == EINTR || error == ESTALE;
        if (!again) return FileLock(-1);
        if (Clock::now() >= end) return held_too_long(path, wait);
        if (error != 0) std::this_thread::sleep_for(kPause);
    }
}

FileLock::FileLock(FileLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

FileLock::~FileLock() {
    if (file_ < 0) return;
    // Not by closing alone: a child process that is just being started has the file open, too.
    ::flock(file_, LOCK_UN);
    ::close(file_);
}

}  // namespace weft
