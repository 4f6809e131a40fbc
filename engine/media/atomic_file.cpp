#include "engine/media/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <ctime>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>

#include "engine/core/hash.h"

namespace weft {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kMark = ".weft-";
constexpr std::time_t kAbandonedAfter_s = 24 * 3600;

// Temporaries of this process that are being written, so that those of an earlier process with the
// same number (containers reuse them) can be told apart.
// Never destroyed: abandon_temporaries() may run while the process ends.
class LiveNames {
  public:
    static LiveNames& instance() {
        static auto* const live = new LiveNames;
        return *live;
    }
    void add(const std::string& path) {
        const std::lock_guard lock(mutex_);
        paths_[fs::path(path).filename().string()] = path;
    }
    void remove(const std::string& path) {
        const std::lock_guard lock(mutex_);
        paths_.erase(fs::path(path).filename().string());
    }
    bool has(const std::string& file_name) {
        const std::lock_guard lock(mutex_);
        return paths_.contains(file_name);
    }
    void abandon() {
        mutex_.lock();  // and never unlocked
        std::error_code ignored;
        for (const auto& [name, path] : paths_)
            fs::remove_all(path, ignored);
    }

  private:
    std::mutex mutex_;
    std::map<std::string, std::string> paths_;  // by file name, which is of this process alone
};

// Process numbers mean something on one host only, and a render farm shares folders.
std::string host_tag() {
    char host[256] = {};
    gethostname(host, sizeof host - 1);
    Hasher hasher;
    hasher.text(host);
    return hasher.finish().hex().substr(0, 8);
}

// ".plate.0012.weft-HOST-PID-COUNT.png", in the folder of `target`.
std::string temporary_name(const std::string& target) {
    static std::atomic<unsigned> counter{0};
    const fs::path path(target);
    const std::string extension = path.extension().string();
    const std::string tail = std::string(kMark) + host_tag() + "-" + std::to_string(getpid()) +
                             "-" + std::to_string(counter.fetch_add(1)) + extension;
    constexpr std::size_t kNameMax = 255;
    std::string stem = path.stem().string();
    stem.resize(std::min(stem.size(), kNameMax - std::min(kNameMax, tail.size() + 1)));
    return (path.parent_path() / ("." + stem + tail)).string();
}

struct Origin {
    std::string host;
    int pid = 0;
};

// Reads what temporary_name() wrote; nothing for any other file.
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

Status write_all(int file, std::span<const std::byte> bytes, const std::string& path) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(file, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return tl::unexpected(system_error(path, "cannot be written", errno));
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return {};
}

// Pipes and devices cannot be flushed, which is no failure.
Status flush(int file, const std::string& path) {
    if (fsync(file) != 0 && errno != EINVAL && errno != EROFS && errno != ENOTSUP) {
        return tl::unexpected(system_error(path, "cannot be written", errno));
    }
    return {};
}

Status close_file(int file, const std::string& path) {
    // Network file systems report a full disk only here. After EINTR the file is closed all the
    // same.
    if (::close(file) != 0 && errno != EINTR) {
        return tl::unexpected(system_error(path, "cannot be written", errno));
    }
    return {};
}

Status write_through(int file, std::span<const std::byte> bytes, const std::string& path) {
    Status status = write_all(file, bytes, path);
    if (status) status = flush(file, path);
    const Status closed = close_file(file, path);
    return status ? closed : status;
}

Status write_to_device(const std::string& path, std::span<const std::byte> bytes) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) return tl::unexpected(system_error(path, "cannot be written", errno));
    return write_through(file, bytes, path);
}

void remove_stale(const fs::path& folder, mode_t kind) {
    std::error_code error;
    fs::directory_iterator entry(folder, error);
    for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
        std::error_code ignored;
        if (is_stale(*entry, kind)) fs::remove_all(entry->path(), ignored);
    }
}

std::string resolved(const std::string& path) {
    std::error_code error;
    if (!fs::is_symlink(path, error)) return path;
    const fs::path target = fs::canonical(path, error);
    return error ? path : target.string();
}

}  // namespace

Error system_error(const std::string& path, std::string_view doing, int error_number) {
    std::string message = path + " " + std::string(doing) + ": ";
    switch (error_number) {
        case ENOSPC:
            return {
                ErrorCode::kNoSpace, message + "the disk is full. Free some space and go on.", {}};
        case EDQUOT:
            return {ErrorCode::kNoSpace,
                    message + "the disk quota is used up. Free some space and go on.",
                    {}};
        case EFBIG:
            return {ErrorCode::kNoSpace,
                    message +
                        "the file would be larger than the system allows. Raise the limit "
                        "(ulimit -f) or write elsewhere.",
                    {}};
        case ENOENT:
        case ENOTDIR:
            return {ErrorCode::kUnreadable,
                    message + "the folder does not exist. Create it first.",
                    {}};
        case EACCES:
        case EPERM:
        case EROFS:
            return {ErrorCode::kUnreadable,
                    message + "no permission. Check the permissions of the file and its folder.",
                    {}};
        case EISDIR:
            return {ErrorCode::kUnreadable, message + "it is a folder. Give a file name.", {}};
        default:
            message += std::generic_category().message(error_number);
            return {ErrorCode::kUnreadable, message + ". Check the disk and the path.", {}};
    }
}

TemporaryFile::TemporaryFile(std::string name, std::string target)
    : name_(std::move(name)), target_(std::move(target)) {
    LiveNames::instance().add(name_);
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : name_(std::exchange(other.name_, {})), target_(std::move(other.target_)) {}

TemporaryFile::~TemporaryFile() {
    if (name_.empty()) return;
    ::unlink(name_.c_str());
    LiveNames::instance().remove(name_);
}

Expected<TemporaryFile> TemporaryFile::create(const std::string& path) {
    const std::string target = resolved(path);
    std::error_code ignored;
    if (fs::is_directory(target, ignored)) {
        return tl::unexpected(system_error(path, "cannot be written", EISDIR));
    }
    // Known as live before it exists: a clean-up in another thread must not take it.
    TemporaryFile temporary(temporary_name(target), target);
    const int file = ::open(temporary.name().c_str(),
                            O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file < 0) return tl::unexpected(system_error(path, "cannot be written", errno));
    WEFT_CHECK_OK(close_file(file, path));
    return temporary;
}

Status TemporaryFile::commit() {
    const int file = ::open(name_.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) return tl::unexpected(system_error(target_, "cannot be written", errno));
    WEFT_CHECK_OK(write_through(file, {}, target_));
    return commit_unflushed();
}

Status TemporaryFile::commit_unflushed() {
    if (::rename(name_.c_str(), target_.c_str()) != 0) {
        return tl::unexpected(system_error(target_, "cannot be written", errno));
    }
    LiveNames::instance().remove(name_);
    name_.clear();
    return {};
}

Status write_file_atomically(const std::string& path, std::span<const std::byte> bytes) {
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) &&
        !S_ISDIR(status.st_mode)) {
        return write_to_device(path, bytes);
    }
    WEFT_TRY(temporary, TemporaryFile::create(path));
    const int file = ::open(temporary.name().c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) return tl::unexpected(system_error(path, "cannot be written", errno));
    const Status written = write_all(file, bytes, path);
    const Status closed = close_file(file, path);
    if (!written) return written;
    WEFT_CHECK_OK(closed);
    return temporary.commit();
}

Status write_file_atomically(const std::string& path, std::string_view text) {
    return write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

void remove_stale_temporaries(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    remove_stale(folder.empty() ? fs::path(".") : folder, S_IFREG);
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
        remove_stale(parent, S_IFDIR);
        TemporaryFolder folder(temporary_name((parent / "folder").string()));
        if (fs::create_directory(folder.path(), error)) {
            fs::permissions(folder.path(), fs::perms::owner_all, error);
            if (!error) return folder;
        }
        if (!error) error = std::make_error_code(std::errc::file_exists);
    }
    return fail(ErrorCode::kNoSpace,
                "No temporary folder can be made: " + error.message() + ". Set TMPDIR.");
}

}  // namespace weft
