#include <sys/mman.h>
#include <unistd.h>

#include <array>

#include "engine/core/input_file.h"
#include "engine/media/open_raster_reader.h"
#include "engine/media/png_reader.h"
#include "engine/media/raster_errors.h"
#include "engine/media/zip_reader.h"

namespace weft {
namespace {

constexpr std::string_view kOpenRasterType = "image/openraster";
constexpr std::string_view kKritaType = "application/x-krita";
constexpr std::uint64_t kLongestType_bytes = 100;

const ZipEntry* entry_named(const ZipReader& archive, std::string_view name) {
    for (const ZipEntry& entry : archive.entries())
        if (entry.path == name) return &entry;
    return nullptr;
}

// Bytes as a file that only this process has, for decoders that read files.
Expected<InputFile> file_of(const std::string& bytes, const std::string& path) {
    const auto full = [&] {
        return fail(ErrorCode::kNoSpace, path + " does not fit into memory.");
    };
    const int descriptor = ::memfd_create("weft", MFD_CLOEXEC);
    if (descriptor < 0) return full();
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t put = ::pwrite(descriptor, bytes.data() + done, bytes.size() - done,
                                     static_cast<off_t>(done));
        if (put <= 0) break;
        done += static_cast<std::size_t>(put);
    }
    auto file = InputFile::open("/proc/self/fd/" + std::to_string(descriptor), path);
    ::close(descriptor);
    if (done < bytes.size()) return full();
    return file;
}

// The PNG of all layers together.
Expected<InputFile> merged_picture(const std::string& path) {
    WEFT_TRY(archive, ZipReader::open(path));
    std::string type;
    const ZipEntry* kind = entry_named(archive, "mimetype");
    if (kind && kind->bytes <= kLongestType_bytes) {
        WEFT_TRY(text, archive.read(*kind));
        type = text.substr(0, text.find_last_not_of("\r\n ") + 1);
    }
    if (type != kOpenRasterType && type != kKritaType) {
        return tl::unexpected(
            unreadable(path, "it is an archive, but neither OpenRaster nor a Krita document",
                       "Export a flattened PNG, TIFF or EXR from the program that wrote it."));
    }
    const ZipEntry* merged = entry_named(archive, "mergedimage.png");
    if (!merged) {
        return tl::unexpected(unreadable(path,
                                         "it has no merged picture (mergedimage.png) of its layers",
                                         "Save it again with Krita, or export a flattened PNG."));
    }
    WEFT_TRY(bytes, archive.read(*merged));
    return file_of(bytes, path);
}

}  // namespace

bool is_zip(const std::string& path) {
    const auto file = InputFile::open(path);
    std::array<char, 4> head{};
    if (!file) return false;
    const auto got = file->read_at(0, head.data(), head.size());
    return got && *got == head.size() && std::string_view(head.data(), 4) == "PK\3\4";
}

Expected<RasterInfo> probe_layered(const std::string& path) {
    WEFT_TRY(picture, merged_picture(path));
    return probe_png(picture, path);
}

Expected<Raster> read_layered(const std::string& path) {
    WEFT_TRY(picture, merged_picture(path));
    return read_png(picture, path, false);
}

}  // namespace weft
