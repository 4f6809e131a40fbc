#include "engine/media/temporary_names.h"

#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>

#include "engine/core/hash.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kMark = ".weft-";
constexpr std::time_t kAbandonedAfter_s = 24 * 3600;

// Process numbers are valid on one host only, and a render farm shares folders.
std::string host_tag() {
    char host[256] = {};
    gethostname(host, sizeof host - 1);
    Hasher hasher;
    hasher.text(host);
    return hasher.finish().hex().substr(0, 8);
}

struct Origin {
    std::string host;
    int pid = 0;
};

// Parses a name from temporary_name(); empty for any other file.
std::optional<Origin> origin_of(const std::string& file_name) {
    const std::size_t mark = file_name.rfind(kMark);
    if (file_name.empty() || file_name[0] != '.' || mark == std::string::npos) return std::nullopt;
    const std::size_t host = mark + kMark.size();
    if (file_name.size() < host + 10 || file_name[host + 8] != '-') return std::nullopt;
    Origin origin{file_name.substr(host, 8), 0};
    const char* const end = file_name.data() + file_name.size();
    const auto [after_pid, error] = std::from_chars(file_name.data() + host + 9, end, origin.pid);
    if (error != std::errc() || after_pid == end || *after_pid != '-') return std::nullopt;
    return origin;
}

bool is_stale(const fs::directory_entry& entry, mode_t kind) {
    const std::string name = entry.path().filename().string();
    const auto origin = origin_of(name);
    struct stat status {};
    if (!origin || LiveNames::instance().has(name)) return false;
    if (lstat(entry.path().c_str(), &status) != 0 || (status.st_mode & S_IFMT) != kind)
        return false;
    if (std::time(nullptr) - status.st_mtime > kAbandonedAfter_s) return true;
    if (origin->host != host_tag()) return false;
    return origin->pid == getpid() || (kill(origin->pid, 0) != 0 && errno == ESRCH);
}

}  // namespace

std::string temporary_name(const std::string& file_name) {
    static std::atomic<unsigned> counter{0};
    const fs::path path(file_name);
    const std::string extension = path.extension().string();
    const std::string tail = std::string(kMark) + host_tag() + "-" + std::to_string(getpid()) +
                             "-" + std::to_string(counter.fetch_add(1)) + extension;
    constexpr std::size_t kNameMax = 255;
    std::string stem = path.stem().string();
    stem.resize(std::min(stem.size(), kNameMax - std::min(kNameMax, tail.size() + 1)));
    return "." + stem + tail;
}

LiveNames& LiveNames::instance() {
    static auto* const live = new LiveNames;
    return *live;
}

void LiveNames::add(const std::string& path) {
    const std::lock_guard lock(mutex_);
    paths_[fs::path(path).filename().string()] = path;
}

void LiveNames::remove(const std::string& path) {
    const std::lock_guard lock(mutex_);
    paths_.erase(fs::path(path).filename().string());
}

bool LiveNames::has(const std::string& file_name) {
    const std::lock_guard lock(mutex_);
    return paths_.contains(file_name);
}

void LiveNames::abandon() {
    mutex_.lock();  // never unlocked
    std::error_code ignored;
    for (const auto& [name, path] : paths_)
        fs::remove_all(path, ignored);
}

void remove_stale(const std::string& folder, mode_t kind) {
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
        std::error_code ignored;
        if (is_stale(*entry, kind)) fs::remove_all(entry->path(), ignored);
    }
}

void remove_stale_temporaries(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    remove_stale(folder.empty() ? "." : folder.string(), S_IFREG);
}

void abandon_temporaries() {
    LiveNames::instance().abandon();
}

TemporaryFolder::TemporaryFolder(std::string path) : path_(std::move(path)) {
    LiveNames::instance().add(path_);
}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})) {}

TemporaryFolder::~TemporaryFolder() {
    if (path_.empty()) return;
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    LiveNames::instance().remove(path_);
}

Expected<TemporaryFolder> TemporaryFolder::create() {
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    if (!error) {
        remove_stale(parent.string(), S_IFDIR);
        TemporaryFolder folder((parent / temporary_name("folder")).string());
        if (fs::create_directory(folder.path(), error)) {
            fs::permissions(folder.path(), fs::perms::owner_all, error);
            if (!error) return folder;
        }
        if (!error) error = std::make_error_code(std::errc::file_exists);
    }
    return fail(ErrorCode::kNoSpace,
                "A temporary folder cannot be created: " + error.message() + ".",
                "Set TMPDIR to a writable folder.");
}

}  // namespace weft
