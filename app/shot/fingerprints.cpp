#include "app/shot/fingerprints.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <tuple>

#include "app/shot/fingerprint_file.h"
#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/media/atomic_file.h"

namespace weft {
struct KnownFile {
    Fingerprint print;
    bool checked = false;         // its sample was read by this process
    Clock::time_point read = {};  // when this process read its contents
};

// The files of one folder.
struct KnownFolder {
    std::map<std::string, KnownFile> files;
    bool loaded = false;
    bool changed = false;  // since it was loaded or saved
};

namespace {

namespace fs = std::filesystem;

// The coarsest clock of a file system in use, FAT's, counts in steps of two seconds.
constexpr std::chrono::seconds kStep{2};

// The device is left out, which another machine or the next start may number in another way.
bool same_file(const FileStamp& a, const FileStamp& b) {
    return std::tie(a.bytes, a.modified_ns, a.changed_ns, a.inode) ==
           std::tie(b.bytes, b.modified_ns, b.changed_ns, b.inode);
}

bool is_older_than_step(const FileStamp& stamp) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::nanoseconds(stamp.changed_ns) < now - kStep;
}

Hash128 new_id(const Fingerprint& of) {
    Hasher hasher;
    hasher.value(of.stamp.bytes).value(of.stamp.modified_ns).value(of.stamp.changed_ns);
    hasher.value(of.stamp.inode).value(of.sample.high).value(of.sample.low);
    // Known where two files had one stamp.
    if (of.contents) hasher.value(of.contents->high).value(of.contents->low);
    return hasher.finish();
}

std::string file_for(const std::string& root, const std::string& folder) {
    Hasher hasher;
    return (fs::path(root) / hasher.text(folder).finish().hex()).string();
}

void write(const std::string& root, const std::string& path, const KnownFolder& folder) {
    std::error_code ignored;
    fs::create_directories(root, ignored);
    const std::string file = file_for(root, path);
    // Another process may have found more of the same folder meanwhile.
    FolderFingerprints all = read_fingerprints(file);
    for (const auto& [name, known] : folder.files)
        all[name] = known.print;
    remove_stale_temporaries(file);
    static_cast<void>(write_fingerprints(file, all));
}

}  // namespace

struct Fingerprints::State {
    std::string root;  // empty: not kept
    StampFn stamp;
    std::mutex mutex;
    std::map<std::string, KnownFolder> folders;  // by absolute path
    std::atomic<std::int64_t> files_read{0};

    // With the lock.
    KnownFolder& folder_at(const std::string& path) {
        KnownFolder& folder = folders[path];
        if (folder.loaded) return folder;
        folder.loaded = true;
        if (root.empty()) return folder;
        for (const auto& [name, print] : read_fingerprints(file_for(root, path)))
            folder.files[name].print = print;
        return folder;
    }
    std::optional<KnownFile> known(const fs::path& path) {
        const std::lock_guard lock(mutex);
        const auto& files = folder_at(path.parent_path().string()).files;
        const auto at = files.find(path.filename().string());
        return at == files.end() ? std::nullopt : std::optional(at->second);
    }
    void keep(const fs::path& path, const KnownFile& found, bool is_new) {
        const std::lock_guard lock(mutex);
        KnownFolder& folder = folder_at(path.parent_path().string());
        folder.files[path.filename().string()] = found;
        folder.changed = folder.changed || is_new;
    }
    // Errors: as hash_of_contents().
    Status read(const std::string& path, KnownFile& into) {
        into.print.settled = is_older_than_step(into.print.stamp);
        into.read = Clock::now();
        WEFT_TRY(contents, hash_of_contents(path));
        ++files_read;
        into.print.contents = contents;
        const auto after = stamp(path);
        into.print.settled = into.print.settled && after && *after == into.print.stamp;
        return {};
    }
    Expected<Fingerprint> find(const std::string& path, bool with_contents);
};

// Either what is known of the file holds, or it is another one.
Expected<Fingerprint> Fingerprints::State::find(const std::string& path, bool with_contents) {
    std::error_code ignored;
    const fs::path whole = fs::absolute(path, ignored).lexically_normal();
    const auto now = stamp(path);
    if (!now) {
        WEFT_TRY(none, hash_of_contents(path));
        return Fingerprint{{}, none, none, none, false};
    }
    const std::optional<KnownFile> before = known(whole);
    KnownFile found;
    found.print.stamp = *now;
    found.checked = true;
    const bool same_stamp = before && same_file(before->print.stamp, *now);
    if (same_stamp && before->checked)
        found.print.sample = before->print.sample;
    else {
        WEFT_TRY(sample, hash_of_sample(path));
        found.print.sample = sample;
    }
    if (same_stamp && found.print.sample == before->print.sample) {
        const bool holds =
            !before->print.contents || before->print.settled || Clock::now() - before->read < kStep;
        if (holds) {
            const bool checked = before->checked;
            found = *before;
            found.checked = true;
            const bool reads = with_contents && !found.print.contents;
            if (reads) WEFT_CHECK_OK(read(path, found));
            if (reads || !checked) keep(whole, found, reads);
            return found.print;
        }
    }
    const bool was_read = before && before->print.contents;
    if (with_contents || was_read) WEFT_CHECK_OK(read(path, found));
    // The step of the clock in which it was written is over, whatever that clock shows.
    if (same_stamp && before->read != Clock::time_point()) found.print.settled = true;
    if (was_read && found.print.contents == before->print.contents) {
        found.print.id = before->print.id;
    } else if (same_stamp) {
        found.print.id = new_id(found.print);
    } else {
        Fingerprint alone = found.print;
        alone.contents.reset();
        found.print.id = new_id(alone);
    }
    keep(whole, found, true);
    return found.print;
}

Fingerprints::Fingerprints(std::string folder, StampFn stamp) : state_(std::make_unique<State>()) {
    state_->root = std::move(folder);
    state_->stamp = std::move(stamp);
}

Fingerprints::~Fingerprints() {
    save();
}

Expected<Hash128> Fingerprints::contents(const std::string& path) {
    WEFT_TRY(found, state_->find(path, true));
    return *found.contents;
}

Expected<Hash128> Fingerprints::id(const std::string& path) {
    WEFT_TRY(found, state_->find(path, false));
    return found.id;
}

void Fingerprints::read(const std::vector<std::string>& paths) {
    parallel_for(paths.size(), [&](std::size_t k) { static_cast<void>(contents(paths[k])); });
}

void Fingerprints::look_at(const std::vector<std::string>& paths) {
    parallel_for(paths.size(), [&](std::size_t k) { static_cast<void>(id(paths[k])); });
}

void Fingerprints::save() {
    if (state_->root.empty()) return;
    const std::lock_guard lock(state_->mutex);
    for (auto& [path, folder] : state_->folders) {
        if (folder.changed) write(state_->root, path, folder);
        folder.changed = false;
    }
}

void Fingerprints::save_to(const std::string& folder) {
    const std::lock_guard lock(state_->mutex);
    for (const auto& [path, of_path] : state_->folders)
        write(folder, path, of_path);
}

std::int64_t Fingerprints::files_read() const {
    return state_->files_read;
}

}  // namespace weft
