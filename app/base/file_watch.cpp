#include "app/base/file_watch.h"

#include <chrono>
#include <map>
#include <optional>
#include <utility>

#include "app/base/background.h"
#include "engine/core/input_file.h"

namespace weft {
namespace {

constexpr auto kLooks = std::chrono::milliseconds(100);

struct Watched {
    std::optional<FileStamp> known, last;  // as it was read, and at the last look; empty: missing
};

// Whether it has been written and is no longer being written.
bool look_at(Watched& file, const std::string& path) {
    const std::optional<FileStamp> now = stamp_of(path);
    const bool settled = now == file.last;
    file.last = now;
    if (!settled || !now || now == file.known) return false;
    file.known = now;
    return true;
}

}  // namespace

FileWatch::FileWatch() : thread_([this] { run(); }) {}

FileWatch::~FileWatch() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

void FileWatch::follow(std::vector<std::string> paths) {
    {
        const std::lock_guard lock(mutex_);
        wanted_ = std::move(paths);
        ++asked_;
    }
    wake_.notify_all();
}

std::vector<std::string> FileWatch::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(written_, {});
}

void FileWatch::run() {
    lower_thread_priority();
    std::map<std::string, Watched> files;
    std::unique_lock lock(mutex_);
    while (!ends_) {
        const std::uint64_t asked = asked_;
        const std::vector<std::string> wanted = wanted_;
        lock.unlock();
        std::map<std::string, Watched> now;
        std::vector<std::string> written;
        for (const std::string& path : wanted) {
            const auto before = files.find(path);
            if (before == files.end()) {
                const auto stamp = stamp_of(path);
                now[path] = {stamp, stamp};
                continue;
            }
            now[path] = before->second;
            if (look_at(now[path], path)) written.push_back(path);
        }
        files = std::move(now);
        lock.lock();
        written_.insert(written_.end(), written.begin(), written.end());
        changes_ += written.size();
        const auto news = [&] { return ends_ || asked_ != asked; };
        // Nothing to look at, nothing to wake up for.
        if (wanted.empty())
            wake_.wait(lock, news);
        else
            wake_.wait_for(lock, kLooks, news);
    }
}

}  // namespace weft
