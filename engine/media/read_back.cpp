#include "engine/media/read_back.h"

#include <OpenImageIO/imageio.h>

#include <vector>

#include "engine/core/input_file.h"
#include "engine/core/text.h"
#include "engine/media/picture_file.h"

namespace weft {
namespace {

using OIIO::ImageInput;
using OIIO::ImageSpec;

std::string facts(Size size, int channels) {
    return size_text(size) + " pixels of " + std::to_string(channels) + " channels";
}

// True if the last rows of an EXR part can be read; they were written last.
bool reads_last_rows(ImageInput& input, int part) {
    const ImageSpec spec = input.spec_dimensions(part, 0);
    const int y1 = spec.y + spec.height;
    const int rows = spec.tile_height > 0 ? spec.height % spec.tile_height == 0
                                                ? spec.tile_height
                                                : spec.height % spec.tile_height
                                          : 1;
    std::vector<unsigned char> samples(static_cast<std::size_t>(rows) * spec.scanline_bytes(true));
    if (spec.tile_width > 0) {
        return input.read_tiles(part, 0, spec.x, spec.x + spec.width, y1 - rows, y1, 0, 1, 0,
                                spec.nchannels, OIIO::TypeDesc::UNKNOWN, samples.data());
    }
    return input.read_scanlines(part, 0, y1 - rows, y1, 0, 0, spec.nchannels,
                                OIIO::TypeDesc::UNKNOWN, samples.data());
}

}  // namespace

Error read_back_error(const std::string& path, const std::string& how) {
    return {ErrorCode::kRenderFailed,
            path + " was not written: read back, the new file " + how + ".",
            "Check the disk, or write another format.",
            {}};
}

Status check_written_picture(const std::string& file, const std::string& path,
                             std::span<const WrittenPart> parts) {
    const auto opened = open_picture(file);
    if (!opened) return tl::unexpected(read_back_error(path, "cannot be opened"));
    const auto& input = *opened;
    const bool exr = std::string_view(input->format_name()) == "openexr";
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const auto part = static_cast<int>(k);
        if (!input->seek_subimage(part, 0)) {
            static_cast<void>(input->geterror());
            return tl::unexpected(read_back_error(
                path,
                "has " + std::to_string(k) + " parts instead of " + std::to_string(parts.size())));
        }
        const ImageSpec spec = input->spec_dimensions(part, 0);
        const Size size{spec.width, spec.height};
        if (size != parts[k].size || spec.nchannels != parts[k].channels) {
            return tl::unexpected(
                read_back_error(path, "has " + facts(size, spec.nchannels) + " instead of " +
                                          facts(parts[k].size, parts[k].channels)));
        }
        if (exr && !reads_last_rows(*input, part)) {
            static_cast<void>(input->geterror());
            return tl::unexpected(read_back_error(path, "ends early"));
        }
    }
    return {};
}

}  // namespace weft
