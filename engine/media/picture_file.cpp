#include "engine/media/picture_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "engine/core/input_file.h"
#include "engine/core/text.h"
#include "engine/media/dpx_header.h"
#include "engine/media/exr_header.h"
#include "engine/media/png_reader.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

using std::string_view_literals::operator""sv;

struct Signature {
    std::string_view bytes, reader;
    std::size_t at = 0;
};

// Signatures of files, with OpenImageIO's names of their readers.
constexpr std::array kSignatures{
    Signature{"\x89PNG"sv, "png"sv},
    Signature{"\xff\xd8\xff"sv, "jpeg"sv},
    Signature{"II*\0"sv, "tiff"sv},
    Signature{"MM\0*"sv, "tiff"sv},
    Signature{"II+\0"sv, "tiff"sv},
    Signature{"MM\0+"sv, "tiff"sv},
    Signature{"\x76\x2f\x31\x01"sv, "openexr"sv},
    Signature{"SDPX"sv, "dpx"sv},
    Signature{"XPDS"sv, "dpx"sv},
    Signature{"\x80\x2a\x5f\xd7"sv, "cineon"sv},
    Signature{"\xd7\x5f\x2a\x80"sv, "cineon"sv},
    Signature{"BM"sv, "bmp"sv},
    Signature{"GIF8"sv, "gif"sv},
    Signature{"WEBP"sv, "webp"sv, 8},
    Signature{"#?"sv, "hdr"sv},
    Signature{"8BPS"sv, "psd"sv},
    Signature{"\x01\xda"sv, "sgi"sv},
    Signature{"FOR4"sv, "iff"sv},
    Signature{"\0\0\0\x0cjP  "sv, "jpeg2000"sv},
    Signature{"\xff\x4f\xff\x51"sv, "jpeg2000"sv},
    Signature{"DDS "sv, "dds"sv},
};

// The reader for a file that begins with `head`; empty if its kind is unknown.
std::string reader_of(const std::string& path, std::string_view head) {
    for (const Signature& s : kSignatures) {
        if (head.size() >= s.at && head.substr(s.at).starts_with(s.bytes))
            return std::string(s.reader);
    }
    if (head.size() > 2 && head[0] == 'P' &&
        std::string_view("1234567fF").find(head[1]) != std::string_view::npos)
        return "pnm";
    // A TGA has no signature.
    const std::string extension = lower_case(std::filesystem::path(path).extension().string());
    return extension == ".tga" ? "targa" : "";
}

// Whether `other` may be the picture instead of `first`. A preview is smaller, and GIMP's layers,
// which may be smaller too, are marked as pages (NewSubfileType, TIFF 6.0, section 8).
bool is_another_picture(const OIIO::ImageSpec& first, const OIIO::ImageSpec& other) {
    constexpr int kReduced = 1, kPage = 2;
    if (other.width == first.width && other.height == first.height) return true;
    const int kind = other.get_int_attribute("tiff:subfiletype");
    if ((kind & kReduced) != 0) return false;
    return (kind & kPage) != 0 || other.width > first.width || other.height > first.height;
}

// Pages, layers and moments: the first is as likely to be the background as the picture.
Status check_pages(const std::string& path, OIIO::ImageInput& input) {
    const OIIO::ImageSpec first = input.spec();
    constexpr int kMostLooks = 64;
    bool several = false;
    for (int page = 1; !several && page < kMostLooks && input.seek_subimage(page, 0); ++page)
        several = is_another_picture(first, input.spec());
    static_cast<void>(input.geterror());
    if (several && first.get_int_attribute("oiio:Movie") != 0)
        return tl::unexpected(animated(path));
    if (several) {
        return tl::unexpected(unreadable(path, "it holds several pictures, as pages or layers",
                                         "Flatten it, or save the one that is meant by itself."));
    }
    if (!input.seek_subimage(0, 0)) return tl::unexpected(damaged(path, input.geterror()));
    return {};
}

// OpenImageIO 2.4 reads wrong colours from an indexed PSD, takes the inks of a multichannel one for
// red, green and blue, and does not know Lab and duotone.
Status check_psd_mode(const std::string& path, std::string_view head) {
    constexpr std::size_t kModeAt = 24;
    constexpr std::array kReadable{0, 1, 3, 4};  // bitmap, grey, RGB, CMYK
    if (head.size() < kModeAt + 2) return {};
    const int mode = static_cast<unsigned char>(head[kModeAt]) << 8 |
                     static_cast<unsigned char>(head[kModeAt + 1]);
    if (std::find(kReadable.begin(), kReadable.end(), mode) != kReadable.end()) return {};
    const std::string name = mode == 2   ? "indexed colours"
                             : mode == 7 ? "multichannel"
                             : mode == 8 ? "duotone"
                             : mode == 9 ? "Lab"
                                         : "number " + std::to_string(mode);
    return tl::unexpected(unreadable(path, "it is a PSD of the colour mode " + name,
                                     "Convert it to RGB or grey, and save it again."));
}

}  // namespace

Status check_picture_file(const std::string& path) {
    WEFT_TRY(stamp, check_input_file(path));
    if (stamp.bytes == 0) {
        return tl::unexpected(unreadable(path, "it is empty (0 bytes)", "Write or copy it again."));
    }
    WEFT_CHECK_OK(check_dpx_layout(path));
    return check_exr_header(path);
}

Expected<std::unique_ptr<OIIO::ImageInput>> open_picture(const std::string& path,
                                                         const OIIO::ImageSpec& config) {
    WEFT_CHECK_OK(check_picture_file(path));
    WEFT_TRY(file, InputFile::open(path));
    std::array<char, 26> head{};
    WEFT_TRY(count, file.read_at(0, head.data(), head.size()));
    const std::string reader = reader_of(path, {head.data(), count});
    if (reader.empty()) {
        return tl::unexpected(unreadable(
            path, "its kind is unknown, so it is damaged, a program's own document, or no picture",
            "Export it as PNG, TIFF or EXR, or write or copy it again."));
    }
    if (reader == "psd") WEFT_CHECK_OK(check_psd_mode(path, {head.data(), count}));
    // OpenImageIO lets libpng print errors of the header.
    if (reader == "png") WEFT_CHECK_OK(probe_png(path));
    auto input = OIIO::ImageInput::create(reader);
    OIIO::ImageSpec spec;
    if (!input || !input->open(path, spec, config)) {
        return tl::unexpected(damaged(path, input ? input->geterror() : OIIO::geterror()));
    }
    // OpenImageIO 2.4 cannot go back to the picture of a still WebP.
    const bool moves = input->spec().get_int_attribute("oiio:Movie") != 0;
    if (reader == "tiff" || reader == "gif" || (reader == "webp" && moves))
        WEFT_CHECK_OK(check_pages(path, *input));
    return input;
}

std::vector<std::string> list_views(OIIO::ImageInput& input) {
    std::vector<std::string> views;
    if (std::string_view(input.format_name()) != "openexr") return views;
    for (int part = 0; input.seek_subimage(part, 0); ++part) {
        const OIIO::ImageSpec& spec = input.spec();
        std::vector<std::string> here{std::string(spec.get_string_attribute("view"))};
        if (const OIIO::ParamValue* all = spec.find_attribute("multiView")) {
            here.clear();
            const auto count = static_cast<int>(all->type().numelements());
            for (int k = 0; k < count; ++k)
                here.push_back(all->get_string_indexed(k));
        }
        for (std::string& view : here) {
            if (!view.empty() && std::find(views.begin(), views.end(), view) == views.end())
                views.push_back(std::move(view));
        }
    }
    static_cast<void>(input.geterror());
    return views;
}

}  // namespace weft
