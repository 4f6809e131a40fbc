#include "engine/media/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "engine/media/temporary_names.h"

namespace weft {
namespace fs = std::filesystem;
namespace {

Status write_all(int file, std::span<const std::byte> bytes, const std::string& path) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(file, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return tl::unexpected(system_error(path, "cannot be written", errno));
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return {};
}

// Pipes and devices cannot be flushed, which is not a failure.
Status flush_file(int file, const std::string& path) {
    if (fsync(file) != 0 && errno != EINVAL && errno != EROFS && errno != ENOTSUP) {
        return tl::unexpected(system_error(path, "cannot be written", errno));
    }
    return {};
}

Status close_file(int file, const std::string& path) {
    // Network file systems report a full disk only here. After EINTR the file is closed
    // nevertheless.
    if (::close(file) != 0 && errno != EINTR) {
        return tl::unexpected(system_error(path, "cannot be written", errno));
    }
    return {};
}

Status write_through(int file, std::span<const std::byte> bytes, const std::string& path) {
    Status status = write_all(file, bytes, path);
    if (status) status = flush_file(file, path);
    const Status closed = close_file(file, path);
    return status ? closed : status;
}

// The file descriptor that the path names. It may refer to a file, which must be appended to, not
// replaced.
std::optional<int> descriptor_in(const std::string& path) {
    if (path == "/dev/stdout") return STDOUT_FILENO;
    if (path == "/dev/stderr") return STDERR_FILENO;
    for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
        int number = -1;
        if (!path.starts_with(folder)) continue;
        const char* const end = path.data() + path.size();
        const auto [at, error] = std::from_chars(path.data() + folder.size(), end, number);
        if (error == std::errc() && at == end && number >= 0) return number;
    }
    return std::nullopt;
}

Status write_to_device(const std::string& path, std::span<const std::byte> bytes) {
    const auto descriptor = descriptor_in(path);
    const int file = descriptor ? ::fcntl(*descriptor, F_DUPFD_CLOEXEC, 0)
                                : ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) return tl::unexpected(system_error(path, "cannot be written", errno));
    return write_through(file, bytes, path);
}

std::string resolved(const std::string& path) {
    std::error_code error;
    if (!fs::is_symlink(path, error)) return path;
    const fs::path target = fs::canonical(path, error);
    return error ? path : target.string();
}

Error cannot_be_written(const std::string& path, int error_number) {
    return system_error(path, "cannot be written", error_number);
}

// Checks whether the rule allows a file of this name in `folder` at this moment.
Status check_target(int folder, const std::string& name, const std::string& real,
                    const std::string& shown, const WriteRule& rule) {
    if (rule.fence) WEFT_CHECK_OK(rule.fence->check(shown, real));
    struct stat status {};
    if (::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
        if (errno == ENOENT) return {};
        return tl::unexpected(cannot_be_written(shown, errno));
    }
    if (S_ISDIR(status.st_mode)) return tl::unexpected(cannot_be_written(shown, EISDIR));
    if (!S_ISREG(status.st_mode) && !S_ISLNK(status.st_mode)) {
        return fail(ErrorCode::kUsage, shown + " is a device or a pipe.", "Give a file name.");
    }
    if (rule.existing == Existing::kRefuse) return tl::unexpected(exists_already(shown));
    return {};
}

// Renames the file without replacing another; EEXIST if there is one.
int rename_new(int folder, const char* from, const char* to) {
    if (::renameat2(folder, from, folder, to, RENAME_NOREPLACE) == 0) return 0;
    if (errno != EINVAL && errno != ENOSYS) return errno;
    // Network file systems do not support such a rename; most of them support links.
    if (::linkat(folder, from, folder, to, 0) == 0) {
        ::unlinkat(folder, from, 0);
        return 0;
    }
    if (errno == EEXIST) return errno;
    return ::renameat(folder, from, folder, to) == 0 ? 0 : errno;
}

}  // namespace

Error system_error(const std::string& path, std::string_view doing, int error_number) {
    std::string message = path + " " + std::string(doing) + ": ";
    switch (error_number) {
        case ENOSPC:
            return {ErrorCode::kNoSpace,
                    message + "the disk is full.",
                    "Free some space and go on.",
                    {}};
        case EDQUOT:
            return {ErrorCode::kNoSpace,
                    message + "the disk quota is used up.",
                    "Free some space and go on.",
                    {}};
        case EFBIG:
            return {ErrorCode::kNoSpace,
                    message + "the file would be larger than the system allows.",
                    "Raise the limit (ulimit -f) or write elsewhere.",
                    {}};
        case ENOENT:
        case ENOTDIR:
            return {ErrorCode::kUnreadable,
                    message + "the folder does not exist.",
                    "Create it first.",
                    {}};
        case EACCES:
        case EPERM:
        case EROFS:
            return {ErrorCode::kUnreadable,
                    message + "no permission.",
                    "Check the permissions of the file and its folder.",
                    {}};
        case EISDIR:
            return {ErrorCode::kUnreadable, message + "it is a folder.", "Give a file name.", {}};
        default:
            message += std::generic_category().message(error_number);
            return {ErrorCode::kUnreadable, message + ".", "Check the disk and the path.", {}};
    }
}

TemporaryFile::TemporaryFile(Place place) : place_(std::move(place)) {
    LiveNames::instance().add(name());
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept : place_(std::move(other.place_)) {
    other.place_.folder = -1;
}

TemporaryFile::~TemporaryFile() {
    if (place_.folder < 0) return;
    if (!committed_) {
        ::unlinkat(place_.folder, place_.temporary.c_str(), 0);
        LiveNames::instance().remove(name());
    }
    ::close(place_.folder);
}

std::string TemporaryFile::name() const {
    return (fs::path(place_.real_folder) / place_.temporary).string();
}

Expected<TemporaryFile> TemporaryFile::create(const std::string& path, const WriteRule& rule) {
    const fs::path target(rule.follow_link ? resolved(path) : path);
    Place place;
    place.shown = path;
    place.rule = rule;
    place.file = target.filename().string();
    if (place.file.empty() || place.file == "." || place.file == "..")
        return tl::unexpected(cannot_be_written(path, EISDIR));
    place.real_folder = fs::path(real_path(target.string())).parent_path().string();
    // By its real path, and kept open, so that later changes of links on the path have no effect.
    place.folder = ::open(place.real_folder.c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (place.folder < 0) return tl::unexpected(cannot_be_written(path, errno));
    std::error_code ignored;
    const fs::path opened =
        fs::read_symlink("/proc/self/fd/" + std::to_string(place.folder), ignored);
    if (opened.is_absolute()) place.real_folder = opened.string();
    // Registered before it exists, so that a clean-up in another thread does not remove it.
    place.temporary = temporary_name(place.file);
    TemporaryFile temporary(std::move(place));
    WEFT_CHECK_OK(temporary.check());
    const int file = ::openat(temporary.place_.folder, temporary.place_.temporary.c_str(),
                              O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file < 0) return tl::unexpected(cannot_be_written(path, errno));
    WEFT_CHECK_OK(close_file(file, path));
    return temporary;
}

Status TemporaryFile::check() const {
    const std::string real = (fs::path(place_.real_folder) / place_.file).string();
    return check_target(place_.folder, place_.file, real, place_.shown, place_.rule);
}

Expected<int> TemporaryFile::open(int flags) const {
    const int file = ::openat(place_.folder, place_.temporary.c_str(),
                              O_WRONLY | O_NOFOLLOW | O_CLOEXEC | flags);
    if (file < 0) return tl::unexpected(cannot_be_written(place_.shown, errno));
    return file;
}

Status TemporaryFile::write(std::span<const std::byte> bytes) {
    WEFT_TRY(file, open(O_TRUNC));
    const Status written = write_all(file, bytes, place_.shown);
    const Status closed = close_file(file, place_.shown);
    return written ? closed : written;
}

Status TemporaryFile::check_disk() const {
    static constexpr std::array<std::byte, 64 << 10> kBlock{};
    WEFT_TRY(file, open(O_APPEND));
    return write_through(file, kBlock, place_.shown);
}

Status TemporaryFile::flush() const {
    WEFT_TRY(file, open(0));
    return write_through(file, {}, place_.shown);
}

Status TemporaryFile::commit() {
    WEFT_CHECK_OK(flush());
    return commit_unflushed();
}

Status TemporaryFile::commit_unflushed() {
    // Checks again: another file or a link may have appeared there since.
    WEFT_CHECK_OK(check());
    const char* const from = place_.temporary.c_str();
    const char* const to = place_.file.c_str();
    const int error = place_.rule.existing == Existing::kRefuse
                          ? rename_new(place_.folder, from, to)
                      : ::renameat(place_.folder, from, place_.folder, to) == 0 ? 0
                                                                                : errno;
    if (error == EEXIST) return tl::unexpected(exists_already(place_.shown));
    if (error != 0) return tl::unexpected(cannot_be_written(place_.shown, error));
    LiveNames::instance().remove(name());
    committed_ = true;
    return {};
}

Status write_file_atomically(const std::string& path, std::span<const std::byte> bytes,
                             const WriteRule& rule) {
    if (rule.device && is_device(path)) return write_to_device(path, bytes);
    WEFT_TRY(temporary, TemporaryFile::create(path, rule));
    WEFT_CHECK_OK(temporary.write(bytes));
    return temporary.commit();
}

Status write_file_atomically(const std::string& path, std::string_view text,
                             const WriteRule& rule) {
    return write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())), rule);
}

Status copy_file_atomically(const std::string& from, const std::string& to, const WriteRule& rule) {
    WEFT_TRY(temporary, TemporaryFile::create(to, rule));
    std::error_code error;
    fs::copy_file(from, temporary.name(), fs::copy_options::overwrite_existing, error);
    if (error) return tl::unexpected(cannot_be_written(to, error.value()));
    return temporary.commit();
}

bool is_device(const std::string& path) {
    struct stat status {};
    if (descriptor_in(path)) return true;
    return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) &&
           !S_ISDIR(status.st_mode);
}

Status check_output(const std::string& path, const WriteRule& rule) {
    if (rule.device && is_device(path)) return {};
    const fs::path folder = fs::path(path).parent_path();
    std::error_code ignored;
    if (!folder.empty() && fs::symlink_status(folder, ignored).type() == fs::file_type::not_found)
        return rule.fence ? rule.fence->check_folder(folder.string()) : Status();
    const auto probe = TemporaryFile::create(path, rule);
    if (!probe) return tl::unexpected(probe.error());
    return {};
}

Status make_folder(const std::string& folder, const WriteRule& rule) {
    if (folder.empty()) return {};
    if (rule.fence) WEFT_CHECK_OK(rule.fence->check_folder(folder));
    std::error_code error;
    fs::create_directories(folder, error);
    if (!error) return {};
    return fail(ErrorCode::kUnreadable,
                "The folder " + folder + " cannot be created: " + error.message() + ".",
                "Choose another folder.");
}

Status make_folder_of(const std::string& path, const WriteRule& rule) {
    return make_folder(fs::path(path).parent_path().string(), rule);
}

}  // namespace weft
