#include "engine/media/zip_reader.h"

#include <zip.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include "engine/core/input_file.h"

namespace weft {
namespace {

// No picture of a texture library is larger or compresses better than this.
constexpr std::uint64_t kLargest_bytes = 512ull << 20;
constexpr std::uint64_t kSteepestRatio = 1100;  // deflate's own limit is about 1032
constexpr std::uint64_t kMostEntries = 1'000'000;

constexpr std::uint64_t kDirectoryEntry_bytes = 46;  // and the name

std::uint64_t little(const char* s, int bytes) {
    std::uint64_t v = 0;
    for (int i = bytes - 1; i >= 0; --i)
        v = v << 8 | static_cast<unsigned char>(s[i]);
    return v;
}

struct CloseEntry {
    void operator()(zip_file_t* file) const { zip_fclose(file); }
};

Error damaged_archive(const std::string& path, const std::string& why) {
    return {
        ErrorCode::kUnreadable, path + " cannot be read as a zip archive: " + why + ".", {}, {}};
}

Error open_error(const std::string& path, zip_error_t* error) {
    if (zip_error_code_zip(error) == ZIP_ER_MEMORY)
        return {ErrorCode::kNoSpace, "Out of memory while opening " + path + ".", {}, {}};
    return damaged_archive(path, zip_error_strerror(error));
}

// libzip allocates room for as many entries as a zip64 archive claims, before it reads any: 100
// bytes could request all memory. So every record that libzip may find at the file's end is checked
// first.
Status check_counts(const InputFile& file, const std::string& path) {
    constexpr std::uint64_t kTail_bytes = 65535 + 22 + 20;  // a comment, the two last records
    constexpr std::size_t kLocator_bytes = 20, kRecord_bytes = 56;
    const std::uint64_t start = file.bytes() - std::min(file.bytes(), kTail_bytes);
    std::string tail(file.bytes() - start, '\0');
    WEFT_TRY(got, file.read_at(start, tail.data(), tail.size()));
    tail.resize(got);
    const std::uint64_t room = file.bytes() / kDirectoryEntry_bytes;
    for (std::size_t at = tail.find("PK\6\7"); at != std::string::npos;
         at = tail.find("PK\6\7", at + 1)) {
        if (at + kLocator_bytes > tail.size()) break;
        std::array<char, kRecord_bytes> record{};
        const std::uint64_t offset = little(&tail[at + 8], 8);
        if (offset > file.bytes()) continue;  // libzip finds no record there
        WEFT_TRY(bytes, file.read_at(offset, record.data(), record.size()));
        if (bytes < record.size()) continue;
        for (const std::size_t field : {std::size_t{24}, std::size_t{32}}) {
            const std::uint64_t count = little(&record[field], 8);
            if (count > kMostEntries)
                return tl::unexpected(damaged_archive(path, "it has more than a million entries"));
            if (count > room)
                return tl::unexpected(
                    damaged_archive(path, "it claims more entries than it can hold"));
        }
    }
    return {};
}

Error read_error(const std::string& what, const zip_error_t* error) {
    switch (zip_error_code_zip(error)) {
        case ZIP_ER_CRC:
            return {ErrorCode::kUnreadable,
                    what + " has a wrong checksum.",
                    "Save it again, or download it again.",
                    {}};
        case ZIP_ER_MEMORY:
            return {ErrorCode::kNoSpace, "Out of memory while unpacking " + what + ".", {}, {}};
        default:
            return {ErrorCode::kUnreadable,
                    what + " is damaged.",
                    "Save it again, or download it again.",
                    {}};
    }
}

bool is_trusted(const zip_stat_t& s) {
    constexpr zip_uint64_t kNeeded =
        ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
    if ((s.valid & kNeeded) != kNeeded) return false;
    const bool known = s.comp_method == ZIP_CM_STORE || s.comp_method == ZIP_CM_DEFLATE;
    // Checks the size first: a zip64 entry may claim so much that the product would overflow.
    const bool bomb = s.size > kLargest_bytes || s.size / kSteepestRatio > s.comp_size + 64;
    return known && !bomb && s.encryption_method == ZIP_EM_NONE;
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

// The source for libzip: an InputFile, which is known to be a regular file.
struct ZipReader::Source {
    InputFile file;
    std::uint64_t position = 0;
    zip_error_t error{};

    zip_int64_t read(void* data, zip_uint64_t count) {
        const auto got = file.read_at(position, data, count);
        if (!got) {
            zip_error_set(&error, ZIP_ER_READ, EIO);
            return -1;
        }
        position += *got;
        return static_cast<zip_int64_t>(*got);
    }
    zip_int64_t seek(void* data, zip_uint64_t count) {
        const zip_int64_t to =
            zip_source_seek_compute_offset(position, file.bytes(), data, count, &error);
        if (to < 0) return -1;
        position = static_cast<std::uint64_t>(to);
        return 0;
    }
    zip_int64_t stat(void* data, zip_uint64_t count) {
        if (count < sizeof(zip_stat_t)) return -1;
        auto* s = static_cast<zip_stat_t*>(data);
        zip_stat_init(s);
        s->size = file.bytes();
        s->valid |= ZIP_STAT_SIZE;
        return sizeof(zip_stat_t);
    }

    static zip_int64_t serve(void* self, void* data, zip_uint64_t count, zip_source_cmd_t command) {
        auto& source = *static_cast<Source*>(self);
        switch (command) {
            case ZIP_SOURCE_OPEN:
                source.position = 0;
                return 0;
            case ZIP_SOURCE_READ:
                return source.read(data, count);
            case ZIP_SOURCE_SEEK:
                return source.seek(data, count);
            case ZIP_SOURCE_TELL:
                return static_cast<zip_int64_t>(source.position);
            case ZIP_SOURCE_STAT:
                return source.stat(data, count);
            case ZIP_SOURCE_ERROR:
                return zip_error_to_data(&source.error, data, count);
            case ZIP_SOURCE_CLOSE:
            case ZIP_SOURCE_FREE:
                return 0;
            case ZIP_SOURCE_SUPPORTS:
                return ZIP_SOURCE_SUPPORTS_SEEKABLE;
            default:
                zip_error_set(&source.error, ZIP_ER_OPNOTSUPP, 0);
                return -1;
        }
    }
};

void ZipReader::FreeSource::operator()(Source* source) const {
    delete source;
}

void ZipReader::Close::operator()(zip* archive) const {
    zip_discard(archive);
}

Expected<ZipReader> ZipReader::open(const std::string& path) {
    WEFT_TRY(file, InputFile::open(path, "The archive"));
    // libzip reads an empty file as an empty archive.
    if (file.bytes() == 0) return tl::unexpected(damaged_archive(path, "it is empty"));
    WEFT_CHECK_OK(check_counts(file, path));
    ZipReader out;
    out.path_ = path;
    out.source_.reset(new Source{std::move(file)});
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_function_create(&Source::serve, out.source_.get(), &error);
    if (source) out.archive_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
    if (!out.archive_) {
        zip_source_free(source);
        Error failure = open_error(path, &error);
        zip_error_fini(&error);
        return tl::unexpected(std::move(failure));
    }
    zip_error_fini(&error);
    const zip_int64_t count = zip_get_num_entries(out.archive_.get(), 0);
    for (zip_int64_t i = 0; i < count; ++i) {
        const auto index = static_cast<zip_uint64_t>(i);
        zip_stat_t s;
        // Names without translation, also if they are not UTF-8.
        if (zip_stat_index(out.archive_.get(), index, ZIP_FL_ENC_RAW, &s) != 0 || !s.name)
            return tl::unexpected(damaged_archive(path, "its table of contents is damaged"));
        const std::string name = s.name;
        if (name.ends_with('/')) continue;
        if (is_safe_path(name) && is_trusted(s)) {
            out.entries_.push_back({name, index, s.size});
        } else {
            out.refused_.push_back(name);
        }
    }
    return out;
}

Expected<std::string> ZipReader::read(const ZipEntry& entry) {
    const std::string what = path_ + ": " + entry.path;
    const std::unique_ptr<zip_file_t, CloseEntry> file(
        zip_fopen_index(archive_.get(), entry.index, 0));
    if (!file) return tl::unexpected(read_error(what, zip_get_error(archive_.get())));
    std::string out(entry.bytes, '\0');
    std::uint64_t got = 0;
    while (got < entry.bytes) {
        const zip_int64_t n = zip_fread(file.get(), out.data() + got, entry.bytes - got);
        if (n < 0) return tl::unexpected(read_error(what, zip_file_get_error(file.get())));
        if (n == 0) break;
        got += static_cast<std::uint64_t>(n);
    }
    // The end must be reached for the checksum to be compared.
    char more = 0;
    const zip_int64_t beyond = zip_fread(file.get(), &more, 1);
    if (beyond < 0) return tl::unexpected(read_error(what, zip_file_get_error(file.get())));
    if (beyond > 0 || got != entry.bytes) {
        return fail(ErrorCode::kUnreadable, what + " is damaged.",
                    "Save it again, or download it again.");
    }
    return out;
}

}  // namespace weft
