#include "engine/media/exr_frame.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>

#include "engine/core/setting.h"
#include "engine/media/atomic_file.h"
#include "engine/media/exr_part.h"
#include "engine/media/picture_file.h"
#include "engine/media/raster.h"
#include "engine/media/raster_errors.h"
#include "engine/media/read_back.h"

namespace weft {
namespace {

using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

Error cannot_write(const std::string& path, std::string reason) {
    reason = reason.substr(0, reason.find('\n'));
    return {ErrorCode::kUnreadable,
            path + " cannot be written: " +
                (reason.empty() ? "the encoder gave no reason" : reason) + ".",
            "Choose another format or compression.",
            {}};
}

bool loses_nothing(const std::string& compression) {
    static constexpr std::array kLossless{"none", "rle", "zip", "zips", "piz"};
    return std::find(kLossless.begin(), kLossless.end(), compression) != kLossless.end();
}

Expected<std::vector<ExrPart>> read_parts(const std::string& path) {
    WEFT_TRY(input, open_picture(path));
    std::vector<ExrPart> parts;
    for (int k = 0; input->seek_subimage(k, 0); ++k) {
        ExrPart part;
        part.spec = input->spec();
        if (part.spec.deep) {
            return tl::unexpected(unreadable(path, "it holds deep samples, which are not kept",
                                             "Flatten it, or write another format."));
        }
        WEFT_CHECK_OK(check_memory(path, {part.spec.width, part.spec.height},
                                   static_cast<int>(part.pixel_bytes() / 4 + 1)));
        part.bytes.resize(part.pixel_bytes() * static_cast<std::size_t>(part.spec.width) *
                          static_cast<std::size_t>(part.spec.height));
        if (!input->read_image(k, 0, 0, part.spec.nchannels, TypeDesc::UNKNOWN,
                               part.bytes.data())) {
            return tl::unexpected(damaged(path, input->geterror()));
        }
        parts.push_back(std::move(part));
    }
    static_cast<void>(OIIO::geterror());
    return parts;
}

// Stores what `sample` gives for each place of a picture in a channel. `origin`: the position of
// the picture's (0, 0) in the part. OpenImageIO adds a pixel's bytes up anew each time it is asked.
template <class Sample>
void fill_channel(ExrPart& part, int channel, Vec2i origin, Size size, const Sample& sample) {
    const std::size_t offset = part.offset_of(channel), step = part.pixel_bytes();
    const TypeDesc format = part.spec.channelformat(channel);
    for (int y = 0; y < size.height; ++y) {
        unsigned char* to = part.pixel(origin.x, origin.y + y) + offset;
        for (int x = 0; x < size.width; ++x, to += step)
            store_sample(to, format, sample(x, y));
    }
}

// `origin`: the position of the picture's (0, 0) in the part.
void fill_layers(ExrPart& part, const std::vector<ExrLayer>& layers, Vec2i origin, Size size) {
    for (const ExrLayer& layer : layers) {
        const std::size_t count = layer.channels.size();
        for (std::size_t c = 0; c < count; ++c) {
            fill_channel(
                part, channel_named(part.spec, layer.channels[c]), origin, size, [&](int x, int y) {
                    const std::size_t pixel =
                        static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                        static_cast<std::size_t>(x);
                    return layer.samples[pixel * count + c];
                });
        }
    }
}

Recti touched_box(const ExrFrame& frame) {
    Recti box{frame.rgb.width(), frame.rgb.height(), 0, 0};
    for (int y = 0; y < frame.touched.height(); ++y) {
        for (int x = 0; x < frame.touched.width(); ++x) {
            if (frame.touched.row(y)[x] == 0) continue;
            box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
                   std::max(box.y1, y + 1)};
        }
    }
    return box;
}

ExrPart picture_over(ExrPart part, const ExrFrame& frame, const std::array<int, 3>& rgb) {
    const Vec2i origin{part.spec.full_x, part.spec.full_y};
    const Recti display{origin.x, origin.y, origin.x + frame.rgb.width(),
                        origin.y + frame.rgb.height()};
    part = with_channels(std::move(part), frame.layers);
    Recti window = part.window();
    if (frame.touched.empty()) {
        window = display;
    } else if (!frame.layers.empty()) {
        window = window.united(display);
    } else if (const Recti box = touched_box(frame); !box.empty()) {
        window = window.united(
            {box.x0 + origin.x, box.y0 + origin.y, box.x1 + origin.x, box.y1 + origin.y});
    }
    part = with_window(std::move(part), window);
    for (std::size_t c = 0; c < 3; ++c) {
        if (frame.touched.empty()) {
            fill_channel(part, rgb[c], origin, frame.rgb.size(),
                         [&](int x, int y) { return frame.rgb.pixel(x, y)[c]; });
            continue;
        }
        const std::size_t offset = part.offset_of(rgb[c]);
        const TypeDesc format = part.spec.channelformat(rgb[c]);
        for (int y = 0; y < frame.rgb.height(); ++y) {
            for (int x = 0; x < frame.rgb.width(); ++x) {
                if (frame.touched.row(y)[x] == 0) continue;
                store_sample(part.pixel(origin.x + x, origin.y + y) + offset, format,
                             frame.rgb.pixel(x, y)[c]);
            }
        }
    }
    fill_layers(part, frame.layers, origin, frame.rgb.size());
    return part;
}

// A part for a picture without a source.
ExrPart fresh_part(const ExrFrame& frame, PixelDepth depth, double pixel_aspect) {
    const bool alpha = !frame.alpha.empty();
    ExrPart part;
    part.spec = ImageSpec(frame.rgb.width(), frame.rgb.height(), alpha ? 4 : 3,
                          depth == PixelDepth::kFloat ? TypeDesc::FLOAT : TypeDesc::HALF);
    part.spec.attribute("DateTime", "1970:01:01 00:00:00");
    if (pixel_aspect != 1)
        part.spec.attribute("PixelAspectRatio", static_cast<float>(pixel_aspect));
    part.bytes.assign(part.pixel_bytes() * static_cast<std::size_t>(frame.rgb.width()) *
                          static_cast<std::size_t>(frame.rgb.height()),
                      0);
    if (alpha)
        fill_channel(part, 3, {0, 0}, frame.rgb.size(),
                     [&](int x, int y) { return frame.alpha.row(y)[x]; });
    return part;
}

// What the artist says of the plate's pixels replaces what its header says.
void keep_aspect(ImageSpec& spec, double pixel_aspect) {
    const char* const kName = "PixelAspectRatio";
    if (sane_pixel_aspect(spec.get_float_attribute(kName, 1.0f)) != pixel_aspect)
        spec.attribute(kName, static_cast<float>(pixel_aspect));
}

void finish_spec(ImageSpec& spec, const WriteOptions& options, bool main_part) {
    std::string kept(spec.get_string_attribute("compression", "zip"));
    kept = kept.substr(0, kept.find(':'));
    spec.attribute("compression", options.exr_compression != "auto" ? options.exr_compression
                                  : loses_nothing(kept)             ? kept
                                                                    : "zip");
    // If the plate has no time, OpenImageIO would write the current time.
    if (!spec.find_attribute("DateTime")) spec.attribute("DateTime", "1970:01:01 00:00:00");
    spec.erase_attribute("openexr:lineOrder");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (!main_part) return;
    for (const auto& [name, text] : options.metadata)
        spec.attribute(name, text);
}

bool encode_parts(ImageOutput& output, const std::string& name, std::vector<ExrPart>& parts) {
    std::vector<ImageSpec> specs;
    for (const ExrPart& part : parts)
        specs.push_back(part.spec);
    const auto count = static_cast<int>(parts.size());
    bool ok = count == 1 ? output.open(name, specs[0]) : output.open(name, count, specs.data());
    for (int k = 0; ok && k < count; ++k) {
        ExrPart& part = parts[static_cast<std::size_t>(k)];
        if (k > 0) ok = output.open(name, part.spec, ImageOutput::AppendSubimage);
        ok = ok && output.write_image(TypeDesc::UNKNOWN, part.bytes.data());
        part.bytes = {};
    }
    return ok && output.close();
}

Status write_parts(const std::string& path, std::vector<ExrPart>& parts, const WriteRule& rule) {
    auto output = ImageOutput::create(path);
    if (!output) return tl::unexpected(cannot_write(path, OIIO::geterror()));
    std::vector<WrittenPart> promised;
    for (const ExrPart& part : parts)
        promised.push_back({{part.spec.width, part.spec.height}, part.spec.nchannels});
    WEFT_TRY(temporary, TemporaryFile::create(path, rule));
    if (parts.size() == 1) {
        // Encoded into memory first, so that all disk errors get our messages.
        std::vector<unsigned char> file;
        OIIO::Filesystem::IOVecOutput proxy(file);
        if (!output->set_ioproxy(&proxy) || !encode_parts(*output, path, parts))
            return tl::unexpected(cannot_write(path, output->geterror()));
        WEFT_CHECK_OK(temporary.write(std::as_bytes(std::span(file))));
    } else if (!encode_parts(*output, temporary.name(), parts)) {
        // OpenImageIO 2.4 writes several parts by name only, not through the proxy.
        const std::string reason = output->geterror();
        output.reset();
        WEFT_CHECK_OK(temporary.check_disk());
        return tl::unexpected(cannot_write(path, reason));
    }
    output.reset();
    WEFT_CHECK_OK(check_written_picture(temporary.name(), path, promised));
    return temporary.commit();
}

// The picture's own channels must not be names of a layer.
Status check_layer_names(const std::string& path, const ExrPart& part, const ExrFrame& frame,
                         const std::array<int, 3>& rgb) {
    for (const ExrLayer& layer : frame.layers) {
        for (const int channel : rgb) {
            const std::string& name = part.spec.channelnames[static_cast<std::size_t>(channel)];
            if (std::find(layer.channels.begin(), layer.channels.end(), name) ==
                layer.channels.end())
                continue;
            return fail(
                ErrorCode::kUsage,
                path + " cannot hold both the picture and a layer as " + name + ".",
                "Write the layers to separate files" + by({{setting::kLayersOutput}}) + ".");
        }
    }
    return {};
}

Status write(const std::string& path, const ExrFrame& frame, const WriteOptions& options) {
    std::vector<ExrPart> parts;
    std::size_t main = 0;
    std::array<int, 3> rgb{0, 1, 2};
    if (frame.source.empty()) {
        parts.push_back(fresh_part(frame, options.depth, options.pixel_aspect.value_or(1)));
    } else {
        WEFT_TRY(place, locate_colour(frame.source, frame.source_layer));
        WEFT_TRY(read, read_parts(frame.source));
        parts = std::move(read);
        main = static_cast<std::size_t>(place.part);
        rgb = place.rgb;
        if (main >= parts.size() || parts[main].spec.full_width != frame.rgb.width() ||
            parts[main].spec.full_height != frame.rgb.height()) {
            return tl::unexpected(damaged(frame.source, "it has changed while it was rendered"));
        }
        if (frame.touched.empty()) parts[main].spec.erase_attribute("chromaticities");
    }
    WEFT_CHECK_OK(check_layer_names(path, parts[main], frame, rgb));
    if (!frame.source.empty()) parts[main] = with_depth(std::move(parts[main]), rgb, options.depth);
    if (options.pixel_aspect) keep_aspect(parts[main].spec, *options.pixel_aspect);
    parts[main] = picture_over(std::move(parts[main]), frame, rgb);
    for (std::size_t k = 0; k < parts.size(); ++k)
        finish_spec(parts[k].spec, options, k == main);
    return write_parts(path, parts, options.rule);
}

}  // namespace

bool is_exr_with_colour(const std::string& path, const std::string& layer) {
    return locate_colour(path, layer).has_value();
}

Status write_exr(const std::string& path, const ExrFrame& frame, const WriteOptions& options) {
    try {
        return write(path, frame, options);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::kNoSpace, path + " cannot be written: out of memory.");
    } catch (const std::exception& e) {
        return tl::unexpected(cannot_write(path, e.what()));
    }
}

}  // namespace weft
