#include "engine/core/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

namespace weft {
namespace {

constexpr std::size_t kBlock_bytes = std::size_t{1} << 20;

std::string name_of(const std::string& path, std::string_view what) {
    return what.empty() ? path : std::string(what) + " " + path;
}

tl::unexpected<Error> refused(const std::string& name, const std::string& reason,
                              const std::string& advice) {
    return fail(ErrorCode::kUnreadable, name + " cannot be read: " + reason + ".", advice);
}

tl::unexpected<Error> system_fault(const std::string& name, int number) {
    if (number == ENOENT || number == ENOTDIR)
        return refused(name, "no such file", "Check the path.");
    if (number == EACCES || number == EPERM)
        return refused(name, "permission is denied", "Check its permissions.");
    if (number == ELOOP) return refused(name, "its symbolic links form a loop", "Check the path.");
    return refused(name, std::generic_category().message(number), "Check the path and the disk.");
}

std::int64_t nanoseconds(const timespec& time) {
    return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

FileStamp stamp_from(const struct stat& status) {
    return {static_cast<std::uint64_t>(status.st_size), nanoseconds(status.st_mtim),
            nanoseconds(status.st_ctim), static_cast<std::uint64_t>(status.st_dev),
            static_cast<std::uint64_t>(status.st_ino)};
}

// What stands where a file was expected.
const char* other_kind(mode_t mode) {
    if (S_ISDIR(mode)) return "a folder";
    if (S_ISFIFO(mode)) return "a named pipe";
    if (S_ISSOCK(mode)) return "a socket";
    return "a device";
}

tl::unexpected<Error> too_large(const std::string& name, std::uint64_t limit_bytes) {
    return refused(
        name,
        "it is larger than " + std::to_string(limit_bytes >> 20) + " MB, the limit for such files",
        "Check the path.");
}

// Reads up to the end or the limit. `next` fills a block and returns how much it holds, or an
// error.
template <class Next>
Expected<std::string> read_all(const std::string& name, std::uint64_t limit_bytes,
                               std::uint64_t expected_bytes, Next&& next) {
    try {
        std::string text;
        text.reserve(static_cast<std::size_t>(std::min(expected_bytes, limit_bytes)));
        std::vector<char> block(kBlock_bytes);
        for (;;) {
            WEFT_TRY(count, next(block.data(), block.size()));
            if (count == 0) return text;
            if (text.size() + count > limit_bytes) return too_large(name, limit_bytes);
            text.append(block.data(), count);
        }
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::kNoSpace, name + " does not fit into memory.",
                    "Close other programs.");
    }
}

}  // namespace

std::optional<FileStamp> stamp_of(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
    return stamp_from(status);
}

Expected<InputFile> InputFile::open(const std::string& path, std::string_view what,
                                    std::uint64_t limit_bytes) {
    const std::string name = name_of(path, what);
    const auto not_a_file = [&](mode_t mode) {
        return refused(name, std::string("it is ") + other_kind(mode) + ", not a file",
                       "Give the name of a file.");
    };
    // Looked at before it is opened, because opening alone makes some devices do something.
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return system_fault(name, errno);
    if (!S_ISREG(status.st_mode)) return not_a_file(status.st_mode);
    // It may have become a pipe since; without O_NONBLOCK opening one waits for a writer.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (descriptor < 0) return system_fault(name, errno);
    InputFile file(descriptor, name, {});
    if (::fstat(descriptor, &status) != 0) return system_fault(name, errno);
    if (!S_ISREG(status.st_mode)) return not_a_file(status.st_mode);
    file.stamp_ = stamp_from(status);
    if (file.stamp_.bytes > limit_bytes) return too_large(name, limit_bytes);
    return file;
}

InputFile::InputFile(InputFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      name_(std::move(other.name_)),
      stamp_(other.stamp_) {}

InputFile& InputFile::operator=(InputFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(name_, other.name_);
    std::swap(stamp_, other.stamp_);
    return *this;
}

InputFile::~InputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

Expected<std::size_t> InputFile::read_at(std::uint64_t offset, void* to, std::size_t count) const {
    std::size_t done = 0;
    while (done < count) {
        const ssize_t got = ::pread(descriptor_, static_cast<char*>(to) + done, count - done,
                                    static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return system_fault(name_, errno);
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

Expected<FileStamp> check_input_file(const std::string& path, std::string_view what,
                                     std::uint64_t limit_bytes) {
    WEFT_TRY(file, InputFile::open(path, what, limit_bytes));
    return file.stamp();
}

Expected<std::string> read_file(const std::string& path, std::string_view what,
                                std::uint64_t limit_bytes) {
    WEFT_TRY(file, InputFile::open(path, what, limit_bytes));
    std::uint64_t offset = 0;
    return read_all(name_of(path, what), limit_bytes, file.bytes(),
                    [&](char* to, std::size_t count) -> Expected<std::size_t> {
                        WEFT_TRY(got, file.read_at(offset, to, count));
                        offset += got;
                        return got;
                    });
}

Expected<std::string> read_standard_input(std::string_view what, std::uint64_t limit_bytes) {
    const std::string name = std::string(what) + " on standard input";
    return read_all(name, limit_bytes, 0,
                    [&](char* to, std::size_t count) -> Expected<std::size_t> {
                        for (;;) {
                            const ssize_t got = ::read(STDIN_FILENO, to, count);
                            if (got >= 0) return static_cast<std::size_t>(got);
                            if (errno != EINTR) return system_fault(name, errno);
                        }
                    });
}

Expected<Hash128> hash_of_contents(const std::string& path, std::string_view what) {
    WEFT_TRY(file, InputFile::open(path, what));
    Hasher hasher;
    std::vector<char> block(kBlock_bytes);
    for (std::uint64_t offset = 0;;) {
        WEFT_TRY(count, file.read_at(offset, block.data(), block.size()));
        if (count == 0) return hasher.finish();
        hasher.bytes(block.data(), count);
        offset += count;
    }
}

}  // namespace weft
