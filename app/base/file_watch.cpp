#include "app/base/file_watch.h"

namespace weft {

void FileWatch::watch(const std::vector<std::string>& paths) {
    files_.clear();
    for (const std::string& path : paths) {
        const auto now = stamp_of(path);
        files_[path] = {now, now};
    }
}

bool FileWatch::saved() {
    const auto now = std::chrono::steady_clock::now();
    if (now - looked_at_ < kLook) return false;
    looked_at_ = now;
    bool out = false;
    for (auto& [path, file] : files_) {
        const auto stamp = stamp_of(path);
        const bool rests = stamp == file.looked;
        file.looked = stamp;
        // A program may remove a file before it writes it anew.
        if (!rests || !stamp || stamp == file.known) continue;
        file.known = stamp;
        out = true;
    }
    return out;
}

}  // namespace weft
