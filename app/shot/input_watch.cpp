#include "app/shot/input_watch.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>

#include "engine/core/input_file.h"
#include "engine/core/setting.h"

namespace weft {
struct WatchedFile {
    FileStamp stamp;  // state when the run first relied on it
    bool read = false;
    bool changed_before_read = false;
    std::optional<Hash128> hash;  // hash at the first read
};

namespace {

bool same_but_for_rights(const FileStamp& a, const FileStamp& b) {
    return std::tie(a.bytes, a.modified_ns, a.device, a.inode) ==
           std::tie(b.bytes, b.modified_ns, b.device, b.inode);
}

bool is_changed(const std::string& path, const WatchedFile& watched) {
    if (watched.changed_before_read) return true;
    const auto now = stamp_of(path);
    if (!now || now->bytes != watched.stamp.bytes) return true;
    if (*now == watched.stamp) return false;
    if (!watched.hash) return !same_but_for_rights(*now, watched.stamp);
    const auto hash = hash_of_contents(path);
    return !hash || *hash != *watched.hash;
}

}  // namespace

struct InputWatch::State {
    std::shared_ptr<Fingerprints> known;  // may be null
    mutable std::mutex mutex;
    std::map<std::string, WatchedFile> files;
};

InputWatch::InputWatch(std::shared_ptr<Fingerprints> files) : state_(std::make_unique<State>()) {
    state_->known = std::move(files);
}
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
        WatchedFile& file = state_->files[path];
        // The original content is gone, so it cannot be compared.
        file.changed_before_read = relied_on && !same_but_for_rights(*stamp, file.stamp);
        file.stamp = *stamp;
        file.read = true;
        if (stamp->bytes > kLargestHashed_bytes) return;
    }
    // Without the lock: the stamp was taken before anyone reads.
    const auto hash = state_->known ? state_->known->contents(path) : hash_of_contents(path);
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
        "The input " + changed.front() + more + " changed during the run; frames may be mixed.",
        "Overwrite them when the inputs are complete" + by({{setting::kOverwrite}}) + ".");
}

}  // namespace weft
