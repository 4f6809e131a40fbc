#include "engine/media/raster.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string_view>

#include "engine/media/channel_choice.h"
#include "engine/media/icc_profile.h"
#include "engine/media/open_raster_reader.h"
#include "engine/media/orientation.h"
#include "engine/media/picture_file.h"
#include "engine/media/plate_decode.h"
#include "engine/media/png_reader.h"
#include "engine/media/raster_errors.h"
#include "engine/media/unmade_alpha.h"

namespace weft {
namespace {

using OIIO::ImageInput;
using OIIO::ImageSpec;

// Channels [begin, end) of one part of a file, and which of them, counted from `begin`, are the
// raster's channels.
struct Pick {
    int subimage = 0;
    int begin = 0, end = 0;
    std::vector<int> channels;
    bool has_alpha = false;
};

// Callers process several frames in parallel, so a decoder's own threads would only compete.
void single_threaded() {
    static std::once_flag once;
    std::call_once(once, [] {
        OIIO::attribute("threads", 1);
        OIIO::attribute("exr_threads", -1);
    });
}

Expected<std::unique_ptr<ImageInput>> open_input(const std::string& path) {
    single_threaded();
    ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // the samples as they stand in the file
    return open_picture(path, config);
}

SampleKind kind_of(OIIO::TypeDesc type) {
    switch (type.basetype) {
        case OIIO::TypeDesc::UINT8:
            return SampleKind::kU8;
        case OIIO::TypeDesc::UINT16:
            return SampleKind::kU16;
        case OIIO::TypeDesc::UINT32:
            return SampleKind::kU32;
        case OIIO::TypeDesc::HALF:
            return SampleKind::kHalf;
        case OIIO::TypeDesc::FLOAT:
            return SampleKind::kFloat;
        default:
            return SampleKind::kOther;
    }
}

SampleKind kind_of(const ImageSpec& spec, const Pick& pick) {
    std::optional<SampleKind> kind;
    for (const int c : pick.channels) {
        const SampleKind k = kind_of(spec.channelformat(pick.begin + c));
        if (!kind || k == *kind) {
            kind = k;
        } else {
            kind = SampleKind::kFloat;
        }
    }
    return kind.value_or(SampleKind::kOther);
}

// Where a format or a file says nothing of it, OpenImageIO takes the colours for associated ones,
// as OpenEXR defines them.
AlphaKind alpha_kind_of(const ImageSpec& spec) {
    return spec.get_int_attribute("oiio:UnassociatedAlpha") != 0 ? AlphaKind::kStraight
                                                                 : AlphaKind::kAssociated;
}

bool is_exr(const ImageInput& input) {
    return std::string_view(input.format_name()) == "openexr";
}

// Only OpenEXR has a display window that differs from the data by design; a TIFF's page position is
// for printers.
Recti display_window(const ImageInput& input, const ImageSpec& spec) {
    if (!is_exr(input)) return {0, 0, spec.width, spec.height};
    return {spec.full_x, spec.full_y, spec.full_x + spec.full_width,
            spec.full_y + spec.full_height};
}

Pick pick_of(const ChannelChoice& choice) {
    Pick pick;
    pick.subimage = choice.part;
    pick.has_alpha = choice.has_alpha;
    const auto [low, high] = std::minmax_element(choice.channels.begin(), choice.channels.end());
    pick.begin = *low;
    pick.end = *high + 1;
    for (const int c : choice.channels)
        pick.channels.push_back(c - pick.begin);
    return pick;
}

// OpenImageIO 2.4 does not say that the second of two channels of a PSD or SGI is alpha. A
// TIFF says itself what its channels are.
int alpha_of(const ImageInput& input) {
    const ImageSpec& spec = input.spec();
    const bool says = is_exr(input) || std::string_view(input.format_name()) == "tiff";
    return says || spec.nchannels != 2 ? spec.alpha_channel : 1;
}

std::vector<PartNames> names_of(ImageInput& input) {
    // Only EXR parts can be pictures of the same frame; elsewhere subimages are pages or
    // thumbnails.
    const int most = is_exr(input) ? 1000 : 1;
    std::vector<PartNames> parts;
    for (int part = 0; part < most && input.seek_subimage(part, 0); ++part) {
        const ImageSpec& spec = input.spec();
        parts.push_back({std::string(spec.get_string_attribute("oiio:subimagename")),
                         spec.channelnames, alpha_of(input), spec.deep});
    }
    static_cast<void>(input.geterror());
    return parts;
}

Expected<Pick> find_pick(ImageInput& input, const std::string& path, const RasterRequest& request) {
    WEFT_TRY(choice, choose_channels(path, names_of(input), request, is_exr(input)));
    input.seek_subimage(choice.part, 0);
    const Pick pick = pick_of(choice);
    const bool as_picture = request.channel.empty() && !request.raw_codes;
    if (is_exr(input) && as_picture && kind_of(input.spec(), pick) == SampleKind::kU32) {
        return tl::unexpected(unreadable(path, "it holds whole numbers (ids), not a picture",
                                         "Choose another layer."));
    }
    return pick;
}

// libjpeg fills the missing rest of a file with grey and only warns. Stray bytes between markers,
// which some cameras write, are harmless.
bool is_harmless(const std::string& message) {
    return message.find("extraneous bytes") != std::string::npos &&
           message.find("remature") == std::string::npos &&
           message.find("bad Huffman") == std::string::npos;
}

template <class T>
Expected<std::vector<T>> read_samples(ImageInput& input, const std::string& path, const Pick& pick,
                                      OIIO::TypeDesc type) {
    const ImageSpec& spec = input.spec();
    const std::size_t wide = static_cast<std::size_t>(pick.end - pick.begin);
    std::vector<T> data(static_cast<std::size_t>(spec.width) *
                        static_cast<std::size_t>(spec.height) * wide);
    const bool ok = input.read_image(pick.subimage, 0, pick.begin, pick.end, type, data.data());
    const std::string message = input.geterror();
    if (!ok || (!message.empty() && !is_harmless(message))) {
        return tl::unexpected(damaged(path, message));
    }
    return data;
}

// Copies the picked channels from the data window into the display window, which is 0 elsewhere.
template <class T>
std::vector<T> arrange(const std::vector<T>& data, const ImageSpec& spec, const Pick& pick,
                       const Recti& display) {
    const auto wide = static_cast<std::size_t>(pick.end - pick.begin);
    const std::size_t count = pick.channels.size();
    const Recti window{spec.x, spec.y, spec.x + spec.width, spec.y + spec.height};
    const Recti shared = window.intersected(display);
    std::vector<T> out(static_cast<std::size_t>(display.width()) *
                       static_cast<std::size_t>(display.height()) * count);
    for (int y = shared.y0; y < shared.y1; ++y) {
        const T* from = data.data() + (static_cast<std::size_t>(y - window.y0) *
                                           static_cast<std::size_t>(spec.width) +
                                       static_cast<std::size_t>(shared.x0 - window.x0)) *
                                          wide;
        T* to = out.data() + (static_cast<std::size_t>(y - display.y0) *
                                  static_cast<std::size_t>(display.width()) +
                              static_cast<std::size_t>(shared.x0 - display.x0)) *
                                 count;
        for (int x = shared.x0; x < shared.x1; ++x, from += wide) {
            for (const int c : pick.channels)
                *to++ = from[c];
        }
    }
    return out;
}

template <class T>
Status fill(Raster& raster, ImageInput& input, const std::string& path, const Pick& pick,
            OIIO::TypeDesc type) {
    const ImageSpec spec = input.spec();
    WEFT_TRY(data, read_samples<T>(input, path, pick, type));
    const Recti display = display_window(input, spec);
    const bool as_it_is =
        display == Recti{spec.x, spec.y, spec.x + spec.width, spec.y + spec.height};
    bool in_order = pick.end - pick.begin == static_cast<int>(pick.channels.size());
    for (std::size_t i = 0; i < pick.channels.size(); ++i) {
        in_order = in_order && pick.channels[i] == static_cast<int>(i);
    }
    if (as_it_is && in_order) {
        raster.samples = std::move(data);
    } else {
        raster.samples = arrange(data, spec, pick, display);
    }
    return {};
}

double fps_of(const ImageSpec& spec) {
    for (const char* name : {"FramesPerSecond", "dpx:FrameRate", "dpx:TemporalFrameRate"}) {
        const double fps = spec.get_float_attribute(name, 0.0f);
        if (fps > 0 && fps < 1000) return fps;
    }
    return 0;
}

double pixel_aspect_of(const ImageInput& input) {
    const ImageSpec& spec = input.spec();
    const double aspect = spec.get_float_attribute("PixelAspectRatio", 1.0f);
    // OpenImageIO 2.4 inverts a JPEG's densities (dots per unit of length).
    const bool inverse = std::string_view(input.format_name()) == "jpeg" && aspect > 0;
    return sane_pixel_aspect(inverse ? 1 / aspect : aspect);
}

// EXR has no such tag; other programs ignore one that is written.
int orientation_of(const ImageInput& input) {
    if (is_exr(input)) return 1;
    const int orientation = input.spec().get_int_attribute("Orientation", 1);
    return orientation >= 1 && orientation <= 8 ? orientation : 1;
}

std::string note_of_exr(const ImageSpec& spec) {
    std::array<float, 8> xy{};
    const OIIO::TypeDesc type(OIIO::TypeDesc::FLOAT, 8);
    if (!spec.getattribute("chromaticities", type, xy.data())) return {};
    std::array<double, 8> wide{};
    std::copy(xy.begin(), xy.end(), wide.begin());
    return note_of_primaries(wide);
}

// The colour of a file whose values are else read as `by_type`.
FileColor color_by_profile(const ImageInput& input, const std::string& path,
                           const std::string& by_type) {
    const std::string_view format = input.format_name();
    const OIIO::ParamValue* profile = input.spec().find_attribute("ICCProfile");
    if (!profile && format == "webp") {
        const std::vector<unsigned char> own = profile_of_webp(path);
        return own.empty() ? FileColor{by_type, {}}
                           : color_of_profile(own.data(), own.size(), by_type);
    }
    if (!profile || profile->type().basetype != OIIO::TypeDesc::UINT8) return {by_type, {}};
    FileColor color = color_of_profile(static_cast<const unsigned char*>(profile->data()),
                                       static_cast<std::size_t>(profile->datasize()), by_type);
    // GIMP 2.10 gives its linear profile to a PSD whose samples are encoded for a display.
    if (format == "psd" && color.note.find("GIMP built-in") != std::string::npos)
        color.space = by_type;
    return color;
}

FileColor color_of(const ImageInput& input, const std::string& path, SampleKind kind) {
    const std::string_view format = input.format_name();
    const std::string transfer(input.spec().get_string_attribute("dpx:Transfer"));
    const bool log =
        format == "cineon" ||
        (format == "dpx" && (transfer == "Logarithmic" || transfer == "Printing density"));
    if (log) return {"cineon", {}};
    const std::string by_type = is_display_encoded(kind) ? "srgb" : "linear";
    return is_exr(input) ? FileColor{by_type, note_of_exr(input.spec())}
                         : color_by_profile(input, path, by_type);
}

Expected<RasterInfo> info_of(const ImageInput& input, const std::string& path, const Pick& pick) {
    const ImageSpec& spec = input.spec();
    const Size size = display_window(input, spec).size();
    if (size.empty() || spec.width <= 0 || spec.height <= 0) {
        return tl::unexpected(damaged(path, "it has no pixels"));
    }
    if (spec.depth > 1) return tl::unexpected(damaged(path, "it is a volume, not a picture"));
    const SampleKind kind = kind_of(spec, pick);
    const int orientation = orientation_of(input);
    const double aspect = pixel_aspect_of(input);
    return RasterInfo{upright(size, orientation),
                      kind,
                      fps_of(spec),
                      lies_on_its_side(orientation) ? 1 / aspect : aspect,
                      color_of(input, path, kind),
                      orientation};
}

Expected<Raster> read_oiio(const std::string& path, const RasterRequest& request) {
    WEFT_TRY(input, open_input(path));
    WEFT_TRY(pick, find_pick(*input, path, request));
    Raster raster;
    WEFT_TRY(info, info_of(*input, path, pick));
    const ImageSpec& spec = input->spec();
    WEFT_CHECK_OK(check_memory(path, {spec.width, spec.height}, pick.end - pick.begin));
    WEFT_CHECK_OK(check_memory(path, info.size, 4));
    const Size stored = info.orientation == 1 ? info.size : upright(info.size, info.orientation);
    raster.info = info;
    raster.channels = static_cast<int>(pick.channels.size());
    raster.has_alpha = pick.has_alpha;
    raster.alpha_kind = alpha_kind_of(spec);
    switch (info.kind) {
        case SampleKind::kU8:
            WEFT_CHECK_OK(fill<std::uint8_t>(raster, *input, path, pick, OIIO::TypeUInt8));
            break;
        case SampleKind::kU16:
            WEFT_CHECK_OK(fill<std::uint16_t>(raster, *input, path, pick, OIIO::TypeUInt16));
            break;
        case SampleKind::kU32:
            WEFT_CHECK_OK(fill<std::uint32_t>(raster, *input, path, pick, OIIO::TypeUInt32));
            break;
        default:
            WEFT_CHECK_OK(fill<float>(raster, *input, path, pick, OIIO::TypeFloat));
            break;
    }
    const std::string_view format = input->format_name();
    if (format == "bmp" || format == "targa") drop_unmade_alpha(raster);
    std::visit(
        [&](auto& samples) {
            samples = upright(std::move(samples), stored, raster.channels, info.orientation);
        },
        raster.samples);
    return raster;
}

Expected<RasterInfo> probe_oiio(const std::string& path, const RasterRequest& request) {
    WEFT_TRY(input, open_input(path));
    WEFT_TRY(pick, find_pick(*input, path, request));
    WEFT_TRY(info, info_of(*input, path, pick));
    info.views = list_views(*input);
    return info;
}

// A PNG has neither layers nor named channels, so OpenImageIO handles such a request and the
// message lists what there is.
bool goes_to_libpng(const std::string& path, const RasterRequest& request) {
    return request.layer.empty() && request.channel.empty() && is_png(path);
}

// The same holds for the merged picture of an archive of layers.
bool is_layered(const std::string& path, const RasterRequest& request) {
    return request.layer.empty() && request.channel.empty() && is_zip(path);
}

}  // namespace

Expected<ColourPlace> locate_colour(const std::string& path, const std::string& layer) {
    return guarded(path, [&]() -> Expected<ColourPlace> {
        WEFT_TRY(input, open_input(path));
        WEFT_TRY(pick, find_pick(*input, path, {layer, {}, false}));
        if (!is_exr(*input) || pick.channels.size() < 3) {
            return tl::unexpected(unreadable(path, "it is not an EXR with R, G and B",
                                             "Give one, or write another format."));
        }
        ColourPlace place;
        place.part = pick.subimage;
        for (std::size_t c = 0; c < 3; ++c)
            place.rgb[c] = pick.begin + pick.channels[c];
        return place;
    });
}

Expected<RasterInfo> probe_raster(const std::string& path, const RasterRequest& request) {
    return guarded(path, [&] {
        if (is_layered(path, request)) return probe_layered(path);
        return goes_to_libpng(path, request) ? probe_png(path) : probe_oiio(path, request);
    });
}

Expected<Raster> read_raster(const std::string& path, const RasterRequest& request) {
    return guarded(path, [&] {
        if (is_layered(path, request)) return read_layered(path);
        return goes_to_libpng(path, request) ? read_png(path, request.raw_codes)
                                             : read_oiio(path, request);
    });
}

}  // namespace weft
