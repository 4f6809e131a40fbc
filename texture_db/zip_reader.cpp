#include "texture_db/zip_reader.h"

#include <zlib.h>

#include <algorithm>

namespace weft {
namespace {

// No picture of a texture library is larger, and none packs better than this.
constexpr std::uint64_t kLargest_bytes = 512ull << 20;
constexpr std::uint64_t kSteepestRatio = 1100;  // deflate's own limit is about 1032

std::uint32_t little(const std::string& s, std::size_t at, int bytes) {
    std::uint32_t v = 0;
    for (int i = bytes - 1; i >= 0; --i)
        v = v << 8 | static_cast<unsigned char>(s[at + static_cast<std::size_t>(i)]);
    return v;
}

Expected<std::string> read_at(std::ifstream& file, std::uint64_t offset, std::uint64_t bytes,
                              const std::string& path) {
    std::string data(bytes, '\0');
    file.clear();
    file.seekg(static_cast<std::streamoff>(offset));
    if (!file.read(data.data(), static_cast<std::streamsize>(bytes)))
        return fail(ErrorCode::kUnreadable, path + " is cut short or damaged. Download it again.");
    return data;
}

}  // namespace

bool is_safe_path(const std::string& path) {
    if (path.empty() || path.size() > 1000 || path.front() == '/') return false;
    if (std::any_of(path.begin(), path.end(), [](char c) {
            return static_cast<unsigned char>(c) < 32 || c == '\\' || c == ':';
        }))
        return false;
    for (std::size_t at = 0; at <= path.size();) {
        const std::size_t end = std::min(path.find('/', at), path.size());
        const std::string part = path.substr(at, end - at);
        const bool last_slash = part.empty() && at == path.size();
        if (part == ".." || part == "." || (part.empty() && !last_slash)) return false;
        at = end + 1;
    }
    return true;
}

Expected<ZipReader> ZipReader::open(const std::string& path) {
    ZipReader zip;
    zip.path_ = path;
    zip.file_ = std::make_unique<std::ifstream>(path, std::ios::binary);
    const auto damaged = [&](const std::string& why) {
        return fail(ErrorCode::kUnreadable,
                    path + " cannot be read as a zip archive: " + why + ".");
    };
    if (!*zip.file_) return damaged("it cannot be opened");
    zip.file_->seekg(0, std::ios::end);
    const auto size = static_cast<std::uint64_t>(zip.file_->tellg());
    if (size < 22) return damaged("it is too short");
    // The end record stands in the last 64 KiB (a comment may follow it).
    const std::uint64_t tail_bytes = std::min<std::uint64_t>(size, 65557);
    WEFT_TRY(tail, read_at(*zip.file_, size - tail_bytes, tail_bytes, path));
    std::size_t end = std::string::npos;
    for (std::size_t at = tail.size() - 22 + 1; at-- > 0;) {
        if (little(tail, at, 4) == 0x06054b50u) {
            end = at;
            break;
        }
    }
    if (end == std::string::npos) return damaged("it has no table of contents");
    const std::uint32_t count = little(tail, end + 10, 2), bytes = little(tail, end + 12, 4);
    const std::uint32_t offset = little(tail, end + 16, 4);
    if (offset == 0xffffffffu) return damaged("zip64 is not supported");
    if (static_cast<std::uint64_t>(offset) + bytes > size)
        return damaged("its table of contents lies outside");
    WEFT_TRY(directory, read_at(*zip.file_, offset, bytes, path));
    std::size_t at = 0;
    for (std::uint32_t i = 0; i < count && at + 46 <= directory.size(); ++i) {
        if (little(directory, at, 4) != 0x02014b50u)
            return damaged("its table of contents is damaged");
        ZipEntry e;
        const std::uint32_t flags = little(directory, at + 8, 2);
        e.method = static_cast<int>(little(directory, at + 10, 2));
        e.crc = little(directory, at + 16, 4);
        e.packed_bytes = little(directory, at + 20, 4);
        e.bytes = little(directory, at + 24, 4);
        const std::size_t name = little(directory, at + 28, 2);
        const std::size_t skip = little(directory, at + 30, 2) + little(directory, at + 32, 2);
        e.offset = little(directory, at + 42, 4);
        if (at + 46 + name > directory.size()) return damaged("its table of contents is damaged");
        e.path = directory.substr(at + 46, name);
        at += 46 + name + skip;
        if (e.path.ends_with('/')) continue;
        const bool bomb =
            e.bytes > kLargest_bytes || e.bytes > (e.packed_bytes + 64) * kSteepestRatio;
        if (!is_safe_path(e.path) || bomb || (flags & 1u) != 0 ||
            (e.method != 0 && e.method != 8)) {
            zip.refused_.push_back(e.path);
        } else {
            zip.entries_.push_back(std::move(e));
        }
    }
    return zip;
}

Expected<std::string> ZipReader::read(const ZipEntry& entry) {
    const std::string what = path_ + ": " + entry.path;
    WEFT_TRY(head, read_at(*file_, entry.offset, 30, what));
    if (little(head, 0, 4) != 0x04034b50u)
        return fail(ErrorCode::kUnreadable, what + " is damaged. Download the archive again.");
    const std::uint64_t start = entry.offset + 30 + little(head, 26, 2) + little(head, 28, 2);
    WEFT_TRY(packed, read_at(*file_, start, entry.packed_bytes, what));
    std::string out;
    if (entry.method == 0) {
        out = std::move(packed);
    } else {
        out.resize(entry.bytes);
        z_stream stream{};
        if (inflateInit2(&stream, -MAX_WBITS) != Z_OK)
            return fail(ErrorCode::kNoSpace, "Out of memory while unpacking " + what + ".");
        stream.next_in = reinterpret_cast<Bytef*>(packed.data());
        stream.avail_in = static_cast<uInt>(packed.size());
        stream.next_out = reinterpret_cast<Bytef*>(out.data());
        stream.avail_out = static_cast<uInt>(out.size());
        const int code = inflate(&stream, Z_FINISH);
        const std::uint64_t made = stream.total_out;
        inflateEnd(&stream);
        if (code != Z_STREAM_END || made != entry.bytes)
            return fail(ErrorCode::kUnreadable, what + " is damaged. Download the archive again.");
    }
    const auto crc = static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(out.data()), static_cast<uInt>(out.size())));
    if (crc != entry.crc)
        return fail(ErrorCode::kUnreadable,
                    what + " has a wrong checksum. Download the archive again.");
    return out;
}

}  // namespace weft
