#include "app/base/recovery.h"

#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cinttypes>
#include <ctime>
#include <filesystem>

#include "app/project/codec/project_file.h"
#include "app/project/codec/project_json.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// Extra keys of snapshots, as JSON text: the path of the project, and what its file held.
constexpr const char* kPathKey = "recovered_from";
constexpr const char* kKnownKey = "recovered_known";
constexpr const char* kHashKey = "recovered_known_hash";

std::string json_text(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

std::string unquoted(const std::string& json) {
    std::string out;
    for (std::size_t k = 1; k + 1 < json.size(); ++k) {
        if (json[k] == '\\') ++k;
        out += json[k];
    }
    return out;
}

Project with_origin(Snapshot snapshot) {
    Project out = std::move(snapshot.project);
    out.extra[kPathKey] = json_text(snapshot.project_path);
    if (!snapshot.known) return out;
    if (auto text = project_to_json(snapshot.known->project)) {
        out.extra[kKnownKey] = std::move(*text);
        out.extra[kHashKey] = json_text(snapshot.known->hash.hex());
    }
    return out;
}

std::optional<std::string> take_key(Project& project, const char* key) {
    const auto found = project.extra.find(key);
    if (found == project.extra.end()) return std::nullopt;
    std::string text = std::move(found->second);
    project.extra.erase(found);
    return text;
}

void take_origin(RecoveredProject& out) {
    if (const auto path = take_key(out.project, kPathKey)) out.project_path = unquoted(*path);
    const auto known = take_key(out.project, kKnownKey), hash = take_key(out.project, kHashKey);
    if (!known || !hash) return;
    auto project = project_from_json(*known);
    ProjectOnDisk file;
    constexpr int kBoth = 2;
    if (!project || std::sscanf(hash->c_str(), "\"%16" SCNx64 "%16" SCNx64 "\"", &file.hash.high,
                                &file.hash.low) != kBoth)
        return;
    file.project = std::move(*project);
    out.known = std::move(file);
}

std::string time_text(const std::string& file) {
    struct stat info {};
    if (stat(file.c_str(), &info) != 0) return {};
    char text[64];
    std::tm parts{};
    localtime_r(&info.st_mtime, &parts);
    std::strftime(text, sizeof text, "%e %B at %H:%M", &parts);
    return text[0] == ' ' ? text + 1 : text;
}

// Whether the editor of a snapshot still runs: a process that has just been killed keeps its number
// until it is waited for, and the number of one that has gone may belong to another program.
bool still_runs(int pid) {
    if (kill(pid, 0) != 0) return false;
    std::error_code error;
    const fs::path own = fs::read_symlink("/proc/self/exe", error);
    if (error) return true;
    const fs::path its = fs::read_symlink("/proc/" + std::to_string(pid) + "/exe", error);
    constexpr std::string_view kReplaced = " (deleted)";
    std::string name = its.filename().string();
    if (name.ends_with(kReplaced)) name.resize(name.size() - kReplaced.size());
    return !error && name == own.filename();
}

}  // namespace

RecoveryWriter::RecoveryWriter(const std::string& folder, std::function<void()> before_writing)
    : file_((fs::path(folder) / ("recovery-" + std::to_string(getpid()) + ".weft")).string()),
      before_writing_(std::move(before_writing)) {
    std::error_code error;
    fs::create_directories(folder, error);
    thread_ = std::thread([this] { work(); });
}

RecoveryWriter::~RecoveryWriter() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

void RecoveryWriter::note(Snapshot snapshot) {
    {
        const std::lock_guard lock(mutex_);
        next_ = std::move(snapshot);
        clear_ = false;
    }
    wake_.notify_all();
}

void RecoveryWriter::clear() {
    {
        const std::lock_guard lock(mutex_);
        next_.reset();
        clear_ = true;
    }
    wake_.notify_all();
}

void RecoveryWriter::flush() {
    std::unique_lock lock(mutex_);
    done_.wait(lock, [&] { return !next_ && !clear_ && !busy_; });
}

std::string RecoveryWriter::take_error() {
    const std::lock_guard lock(mutex_);
    return std::exchange(error_, {});
}

void RecoveryWriter::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [&] { return stop_ || next_ || clear_; });
        if (!next_ && !clear_) return;
        auto snapshot = std::exchange(next_, std::nullopt);
        const bool remove = std::exchange(clear_, false);
        busy_ = true;
        lock.unlock();
        Status written;
        if (remove) {
            std::error_code error;
            fs::remove(file_, error);
        } else {
            if (before_writing_) before_writing_();
            written = save_project(file_, with_origin(std::move(*snapshot)), WriteRule::own());
        }
        lock.lock();
        busy_ = false;
        if (!written) error_ = written.error().text();
        done_.notify_all();
    }
}

std::vector<RecoveredProject> find_recoverable(const std::string& folder) {
    std::vector<std::pair<fs::file_time_type, RecoveredProject>> found;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        int pid = 0;
        if (std::sscanf(name.c_str(), "recovery-%d.weft", &pid) != 1) continue;
        if (!name.ends_with(".weft") || pid == getpid()) continue;
        if (still_runs(pid)) continue;
        auto project = load_project(it->path().string());
        if (!project) continue;
        RecoveredProject one{it->path().string(), {}, time_text(it->path().string()), *project, {}};
        take_origin(one);
        found.emplace_back(it->last_write_time(error), std::move(one));
    }
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<RecoveredProject> out;
    out.reserve(found.size());
    for (auto& entry : found)
        out.push_back(std::move(entry.second));
    return out;
}

}  // namespace weft
