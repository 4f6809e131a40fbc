#include "engine/media/raster.h"

#include <OpenImageIO/imageio.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <string_view>

#include "engine/media/exr_header.h"
#include "engine/media/png_reader.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

using OIIO::ImageInput;
using OIIO::ImageSpec;

// Channels [begin, end) of one part of a file, and which of them, counted from `begin`, make the
// raster's channels.
struct Pick {
    int subimage = 0;
    int begin = 0, end = 0;
    std::vector<int> channels;
    bool has_alpha = false;
};

// The callers work on several frames at a time; a decoder's own threads would only get in their
// way.
void single_threaded() {
    static std::once_flag once;
    std::call_once(once, [] {
        OIIO::attribute("threads", 1);
        OIIO::attribute("exr_threads", -1);
    });
}

Expected<std::unique_ptr<ImageInput>> open_input(const std::string& path) {
    single_threaded();
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) {
        return tl::unexpected(unreadable(path, "there is no such file", "Check the path."));
    }
    if (!S_ISREG(status.st_mode)) {
        return tl::unexpected(unreadable(path, "it is not a file", "Give the name of a picture."));
    }
    if (status.st_size == 0) {
        return tl::unexpected(unreadable(path, "it is empty (0 bytes)", "Write or copy it again."));
    }
    WEFT_CHECK_OK(check_exr_header(path));
    ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // the samples as they stand in the file
    auto input = ImageInput::open(path, &config);
    if (!input) return tl::unexpected(damaged(path, OIIO::geterror()));
    return input;
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

bool same_name(std::string_view a, std::string_view b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
               return std::tolower(static_cast<unsigned char>(x)) ==
                      std::tolower(static_cast<unsigned char>(y));
           });
}

int find_channel(const ImageSpec& spec, const std::string& prefix,
                 std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) {
        for (int c = 0; c < spec.nchannels; ++c) {
            const std::string& have = spec.channelnames[static_cast<std::size_t>(c)];
            if (same_name(have, prefix + std::string(name))) return c;
        }
    }
    return -1;
}

Pick pick_of(int subimage, std::vector<int> absolute, int alpha) {
    Pick pick;
    pick.subimage = subimage;
    if (alpha >= 0) {
        absolute.push_back(alpha);
        pick.has_alpha = true;
    }
    const auto [low, high] = std::minmax_element(absolute.begin(), absolute.end());
    pick.begin = *low;
    pick.end = *high + 1;
    for (const int c : absolute)
        pick.channels.push_back(c - pick.begin);
    return pick;
}

// prefix.R, prefix.G, prefix.B, else a single grey channel under the prefix.
std::optional<Pick> pick_colors(const ImageSpec& spec, int subimage, const std::string& prefix) {
    const int alpha = find_channel(spec, prefix, {"A", "alpha"});
    const int r = find_channel(spec, prefix, {"R", "red"});
    const int g = find_channel(spec, prefix, {"G", "green"});
    const int b = find_channel(spec, prefix, {"B", "blue"});
    if (r >= 0 && g >= 0 && b >= 0) return pick_of(subimage, {r, g, b}, alpha);
    const int y = find_channel(spec, prefix, {"Y", "I", "L", "Z", "V"});
    if (y >= 0) return pick_of(subimage, {y}, alpha);
    return std::nullopt;
}

// For files whose channels have no telling names: by their number.
std::optional<Pick> pick_by_count(const ImageSpec& spec, int subimage) {
    const int alpha = spec.alpha_channel;
    std::vector<int> colors;
    for (int c = 0; c < spec.nchannels && c < 4; ++c) {
        if (c != alpha) colors.push_back(c);
    }
    if (colors.size() == 1 || spec.nchannels == 2) return pick_of(subimage, {colors[0]}, alpha);
    if (colors.size() < 3) return std::nullopt;
    return pick_of(subimage, {colors[0], colors[1], colors[2]}, alpha);
}

std::optional<Pick> pick_in(const ImageInput& input, const ImageSpec& spec, int subimage,
                            const RasterRequest& request) {
    if (!request.channel.empty()) {
        const int c = find_channel(spec, "", {request.channel});
        return c < 0 ? std::nullopt : std::optional(pick_of(subimage, {c}, -1));
    }
    if (!request.layer.empty()) {
        if (auto pick = pick_colors(spec, subimage, request.layer + ".")) return pick;
        // A part of a multi-part file carries the layer's name itself.
        if (!same_name(spec.get_string_attribute("oiio:subimagename"), request.layer)) {
            return std::nullopt;
        }
        return pick_colors(spec, subimage, "");
    }
    if (auto pick = pick_colors(spec, subimage, "")) return pick;
    // An EXR with other channels only holds layers, and which one to take is for the user to say.
    if (is_exr(input) && spec.nchannels != 1) return std::nullopt;
    return pick_by_count(spec, subimage);
}

std::string list_layers(ImageInput& input, bool channels) {
    std::set<std::string> names;
    for (int part = 0; input.seek_subimage(part, 0); ++part) {
        const ImageSpec& spec = input.spec();
        const std::string part_name(spec.get_string_attribute("oiio:subimagename"));
        if (!part_name.empty() && !channels) names.insert(part_name);
        for (const std::string& name : spec.channelnames) {
            const std::size_t dot = name.rfind('.');
            if (channels) {
                names.insert(name);
            } else if (dot != std::string::npos) {
                names.insert(name.substr(0, dot));
            }
        }
    }
    constexpr std::size_t kShown = 12;
    std::string list;
    std::size_t shown = 0;
    for (const std::string& name : names) {
        if (shown++ == kShown) return list + ", …";
        list += (list.empty() ? "" : ", ") + name;
    }
    return list;
}

Error nothing_picked(ImageInput& input, const std::string& path, const RasterRequest& request) {
    const bool channel = !request.channel.empty();
    const std::string list = list_layers(input, channel);
    if (channel) {
        return unreadable(path, "it has no channel '" + request.channel + "'",
                          "Its channels are: " + list + ".");
    }
    const std::string reason = request.layer.empty() ? "it has no channels R, G, B"
                                                     : "it has no layer '" + request.layer + "'";
    return unreadable(
        path, reason,
        list.empty() ? "It has no layers: leave the layer out." : "Its layers are: " + list + ".");
}

Expected<Pick> find_pick(ImageInput& input, const std::string& path, const RasterRequest& request) {
    // Only EXR parts can be pictures of the same frame; elsewhere subimages are pages or
    // thumbnails.
    const int parts = is_exr(input) ? 1000 : 1;
    for (int part = 0; part < parts && input.seek_subimage(part, 0); ++part) {
        if (auto pick = pick_in(input, input.spec(), part, request)) {
            input.seek_subimage(pick->subimage, 0);
            return *pick;
        }
    }
    return tl::unexpected(nothing_picked(input, path, request));
}

// libjpeg fills the missing rest of a file with grey and merely warns. Stray bytes between markers,
// which some cameras write, harm nothing.
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
    // OpenImageIO 2.4 takes a JPEG's densities (dots a unit of length) the wrong way round.
    const bool inverse = std::string_view(input.format_name()) == "jpeg" && aspect > 0;
    return sane_pixel_aspect(inverse ? 1 / aspect : aspect);
}

Expected<RasterInfo> info_of(const ImageInput& input, const std::string& path, const Pick& pick) {
    const ImageSpec& spec = input.spec();
    const Size size = display_window(input, spec).size();
    if (size.empty() || spec.width <= 0 || spec.height <= 0) {
        return tl::unexpected(damaged(path, "it has no pixels"));
    }
    if (spec.depth > 1) return tl::unexpected(damaged(path, "it is a volume, not a picture"));
    return RasterInfo{size, kind_of(spec, pick), fps_of(spec), pixel_aspect_of(input)};
}

Expected<Raster> read_oiio(const std::string& path, const RasterRequest& request) {
    WEFT_TRY(input, open_input(path));
    WEFT_TRY(pick, find_pick(*input, path, request));
    Raster raster;
    WEFT_TRY(info, info_of(*input, path, pick));
    const ImageSpec& spec = input->spec();
    WEFT_CHECK_OK(check_memory(path, {spec.width, spec.height}, pick.end - pick.begin));
    WEFT_CHECK_OK(check_memory(path, info.size, 4));
    raster.info = info;
    raster.channels = static_cast<int>(pick.channels.size());
    raster.has_alpha = pick.has_alpha;
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
    return raster;
}

Expected<RasterInfo> probe_oiio(const std::string& path, const RasterRequest& request) {
    WEFT_TRY(input, open_input(path));
    WEFT_TRY(pick, find_pick(*input, path, request));
    return info_of(*input, path, pick);
}

// A PNG has neither layers nor named channels, so such a request takes OpenImageIO's way to the
// message that lists what there is.
bool goes_to_libpng(const std::string& path, const RasterRequest& request) {
    return request.layer.empty() && request.channel.empty() && is_png(path);
}

}  // namespace

Expected<ColourPlace> locate_colour(const std::string& path, const std::string& layer) {
    return guarded(path, [&]() -> Expected<ColourPlace> {
        WEFT_TRY(input, open_input(path));
        WEFT_TRY(pick, find_pick(*input, path, {layer, {}, false}));
        if (!is_exr(*input) || pick.channels.size() < 3) {
            return tl::unexpected(unreadable(path, "it is no EXR with R, G and B",
                                             "Give one, or write another format."));
        }
        ColourPlace place;
        place.part = pick.subimage;
        for (std::size_t c = 0; c < 3; ++c)
            place.rgb[c] = pick.begin + pick.channels[c];
        return place;
    });
}

Expected<std::vector<std::string>> exr_channels(const std::string& path) {
    return guarded(path, [&]() -> Expected<std::vector<std::string>> {
        WEFT_TRY(input, open_input(path));
        std::vector<std::string> names;
        for (int part = 0; input->seek_subimage(part, 0); ++part) {
            const ImageSpec& spec = input->spec();
            names.insert(names.end(), spec.channelnames.begin(), spec.channelnames.end());
        }
        static_cast<void>(input->geterror());
        return names;
    });
}

Expected<RasterInfo> probe_raster(const std::string& path, const RasterRequest& request) {
    return guarded(path, [&] {
        return goes_to_libpng(path, request) ? probe_png(path) : probe_oiio(path, request);
    });
}

Expected<Raster> read_raster(const std::string& path, const RasterRequest& request) {
    return guarded(path, [&] {
        return goes_to_libpng(path, request) ? read_png(path, request.raw_codes)
                                             : read_oiio(path, request);
    });
}

}  // namespace weft
