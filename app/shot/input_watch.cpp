#include "app/shot/input_watch.h"

#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>

#include "engine/core/input_file.h"
#include "engine/core/setting.h"

namespace weft {
namespace {

// Identifies a file's state without reading it.
struct Stamp {
    std::int64_t bytes = 0, modified_ns = 0, changed_ns = 0;
    std::uint64_t device = 0, inode = 0;
    bool operator==(const Stamp&) const = default;

    [[nodiscard]] bool same_but_for_rights(const Stamp& other) const {
        return std::tie(bytes, modified_ns, device, inode) ==
               std::tie(other.bytes, other.modified_ns, other.device, other.inode);
    }
};

std::int64_t nanoseconds(const timespec& time) {
    return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

std::optional<Stamp> stamp_of(const std::string& path) {
    struct stat found {};
    if (stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
    return Stamp{found.st_size, nanoseconds(found.st_mtim), nanoseconds(found.st_ctim),
                 found.st_dev, found.st_ino};
}

struct Watched {
    Stamp stamp;  // state when the run first relied on it
    bool read = false;
    bool changed_before_read = false;
    std::optional<Hash128> hash;  // hash at the first read
};

bool is_changed(const std::string& path, const Watched& watched) {
    if (watched.changed_before_read) return true;
    const auto now = stamp_of(path);
    if (!now || now->bytes != watched.stamp.bytes) return true;
    if (*now == watched.stamp) return false;
    if (!watched.hash) return !now->same_but_for_rights(watched.stamp);
    const auto hash = hash_of_contents(path);
    return !hash || *hash != *watched.hash;
}

}  // namespace

struct InputWatch::State {
    mutable std::mutex mutex;
    std::map<std::string, Watched> files;
};

InputWatch::InputWatch() : state_(std::make_unique<State>()) {}
InputWatch::~InputWatch() = default;

void InputWatch::relied_on(const std::string& path) {
    const std::lock_guard lock(state_->mutex);
    if (state_->files.contains(path)) return;
    if (const auto stamp = stamp_of(path)) state_->files[path].stamp = *stamp;
}

void InputWatch::before_read(const std::string& path) {
    {
        const std::lock_guard lock(state_->mutex);
        const auto known = state_->files.find(path);
        if (known != state_->files.end() && known->second.read) return;
        const auto stamp = stamp_of(path);
        if (!stamp) return;
        const bool relied_on = known != state_->files.end();
        Watched& file = state_->files[path];
        // The original content is gone, so it cannot be compared.
        file.changed_before_read = relied_on && !stamp->same_but_for_rights(file.stamp);
        file.stamp = *stamp;
        file.read = true;
        if (stamp->bytes > kLargestHashed) return;
    }
    // Without the lock: the stamp was taken before anyone reads.
    const auto hash = hash_of_contents(path);
    const std::lock_guard lock(state_->mutex);
    if (hash) state_->files[path].hash = *hash;
}

std::vector<std::string> InputWatch::changed() const {
    const std::lock_guard lock(state_->mutex);
    std::vector<std::string> out;
    for (const auto& [path, watched] : state_->files) {
        if (watched.read && is_changed(path, watched)) out.push_back(path);
    }
    return out;
}

Status check_unchanged(const std::vector<std::string>& changed) {
    if (changed.empty()) return {};
    const std::string more =
        changed.size() > 1 ? " and " + std::to_string(changed.size() - 1) + " more" : "";
    return fail(
        ErrorCode::kUnreadable,
        "The input " + changed.front() + more +
            " changed during the run; frames may be mixed. Overwrite them when the inputs are "
            "complete" +
            by({{setting::kOverwrite}}) + ".");
}

}  // namespace weft
