#include "engine/media/exr_frame.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/half.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>

#include "engine/media/atomic_file.h"
#include "engine/media/exr_header.h"
#include "engine/media/raster.h"
#include "engine/media/raster_errors.h"

namespace weft {
namespace {

using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

// One part on its way out: native samples of every channel, interleaved.
struct Part {
    ImageSpec spec;
    std::vector<unsigned char> bytes;

    [[nodiscard]] std::size_t pixel_bytes() const { return spec.pixel_bytes(true); }
    [[nodiscard]] std::size_t offset_of(int channel) const {
        return channel == 0 ? 0 : spec.pixel_bytes(0, channel, true);
    }
    [[nodiscard]] Recti window() const {
        return {spec.x, spec.y, spec.x + spec.width, spec.y + spec.height};
    }
    [[nodiscard]] unsigned char* pixel(int x, int y) {
        return bytes.data() +
               (static_cast<std::size_t>(y - spec.y) * static_cast<std::size_t>(spec.width) +
                static_cast<std::size_t>(x - spec.x)) *
                   pixel_bytes();
    }
};

Error cannot_write(const std::string& path, std::string reason) {
    reason = reason.substr(0, reason.find('\n'));
    return {ErrorCode::kUnreadable,
            path +
                " cannot be written: " + (reason.empty() ? "the encoder gave no reason" : reason) +
                ". Choose another format or compression.",
            {}};
}

bool loses_nothing(const std::string& compression) {
    static constexpr std::array kLossless{"none", "rle", "zip", "zips", "piz"};
    return std::find(kLossless.begin(), kLossless.end(), compression) != kLossless.end();
}

Expected<std::vector<Part>> read_parts(const std::string& path) {
    WEFT_CHECK_OK(check_exr_header(path));
    const auto input = ImageInput::open(path);
    if (!input) return tl::unexpected(damaged(path, OIIO::geterror()));
    std::vector<Part> parts;
    for (int k = 0; input->seek_subimage(k, 0); ++k) {
        Part part;
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

void store(unsigned char* to, TypeDesc format, float value) {
    if (format.basetype == TypeDesc::HALF) {
        constexpr float kLargestHalf = 65504.0f;
        const half h(std::isfinite(value) ? std::clamp(value, -kLargestHalf, kLargestHalf) : value);
        std::memcpy(to, &h, sizeof h);
    } else if (format.basetype == TypeDesc::FLOAT) {
        std::memcpy(to, &value, sizeof value);
    } else {
        const auto n = static_cast<std::uint32_t>(std::clamp(value, 0.0f, 4e9f));
        std::memcpy(to, &n, sizeof n);
    }
}

// The same part with another data window; what it had not is 0.
Part with_window(Part part, const Recti& window) {
    if (window == part.window()) return part;
    Part out;
    out.spec = part.spec;
    out.spec.x = window.x0;
    out.spec.y = window.y0;
    out.spec.width = window.width();
    out.spec.height = window.height();
    out.bytes.assign(out.pixel_bytes() * static_cast<std::size_t>(window.width()) *
                         static_cast<std::size_t>(window.height()),
                     0);
    const Recti shared = window.intersected(part.window());
    for (int y = shared.y0; y < shared.y1; ++y) {
        std::memcpy(out.pixel(shared.x0, y), part.pixel(shared.x0, y),
                    out.pixel_bytes() * static_cast<std::size_t>(shared.width()));
    }
    return out;
}

// Adds channels of 0.
Part with_channels(Part part, const std::vector<ExrLayer>& layers) {
    if (layers.empty()) return part;
    Part out;
    out.spec = part.spec;
    out.spec.channelformats = part.spec.channelformats;
    if (out.spec.channelformats.empty())
        out.spec.channelformats.assign(static_cast<std::size_t>(part.spec.nchannels),
                                       part.spec.format);
    for (const ExrLayer& layer : layers) {
        for (const std::string& name : layer.channels) {
            out.spec.channelnames.push_back(name);
            out.spec.channelformats.push_back(layer.full_float ? TypeDesc::FLOAT : TypeDesc::HALF);
            ++out.spec.nchannels;
        }
    }
    const auto pixels =
        static_cast<std::size_t>(part.spec.width) * static_cast<std::size_t>(part.spec.height);
    const std::size_t was = part.pixel_bytes(), is = out.pixel_bytes();
    out.bytes.assign(is * pixels, 0);
    for (std::size_t i = 0; i < pixels; ++i)
        std::memcpy(out.bytes.data() + i * is, part.bytes.data() + i * was, was);
    return out;
}

// `origin`: where the picture's (0, 0) lies in the part.
void fill_layers(Part& part, const std::vector<ExrLayer>& layers, int first, Vec2i origin,
                 Size size) {
    for (const ExrLayer& layer : layers) {
        const auto count = static_cast<int>(layer.channels.size());
        for (int c = 0; c < count; ++c) {
            const std::size_t offset = part.offset_of(first + c);
            const TypeDesc format = part.spec.channelformat(first + c);
            for (int y = 0; y < size.height; ++y) {
                for (int x = 0; x < size.width; ++x) {
                    const std::size_t at =
                        (static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                         static_cast<std::size_t>(x)) *
                            static_cast<std::size_t>(count) +
                        static_cast<std::size_t>(c);
                    store(part.pixel(origin.x + x, origin.y + y) + offset, format,
                          layer.samples[at]);
                }
            }
        }
        first += count;
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

Part picture_over(Part part, const ExrFrame& frame, const std::array<int, 3>& rgb) {
    const Vec2i origin{part.spec.full_x, part.spec.full_y};
    const Recti display{origin.x, origin.y, origin.x + frame.rgb.width(),
                        origin.y + frame.rgb.height()};
    const int first_layer = part.spec.nchannels;
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
        const std::size_t offset = part.offset_of(rgb[c]);
        const TypeDesc format = part.spec.channelformat(rgb[c]);
        for (int y = 0; y < frame.rgb.height(); ++y) {
            for (int x = 0; x < frame.rgb.width(); ++x) {
                if (!frame.touched.empty() && frame.touched.row(y)[x] == 0) continue;
                store(part.pixel(origin.x + x, origin.y + y) + offset, format,
                      frame.rgb.pixel(x, y)[c]);
            }
        }
    }
    fill_layers(part, frame.layers, first_layer, origin, frame.rgb.size());
    return part;
}

// A part of its own for a picture that has no source.
Part fresh_part(const ExrFrame& frame, PixelDepth depth, double pixel_aspect) {
    const bool alpha = !frame.alpha.empty();
    Part part;
    part.spec = ImageSpec(frame.rgb.width(), frame.rgb.height(), alpha ? 4 : 3,
                          depth == PixelDepth::kFloat ? TypeDesc::FLOAT : TypeDesc::HALF);
    part.spec.attribute("DateTime", "1970:01:01 00:00:00");
    if (pixel_aspect != 1)
        part.spec.attribute("PixelAspectRatio", static_cast<float>(pixel_aspect));
    part.bytes.assign(part.pixel_bytes() * static_cast<std::size_t>(frame.rgb.width()) *
                          static_cast<std::size_t>(frame.rgb.height()),
                      0);
    if (alpha) {
        for (int y = 0; y < frame.rgb.height(); ++y) {
            for (int x = 0; x < frame.rgb.width(); ++x)
                store(part.pixel(x, y) + part.offset_of(3), part.spec.format,
                      frame.alpha.row(y)[x]);
        }
    }
    return part;
}

void finish_spec(ImageSpec& spec, const WriteOptions& options, bool main_part) {
    std::string kept(spec.get_string_attribute("compression", "zip"));
    kept = kept.substr(0, kept.find(':'));
    spec.attribute("compression", options.exr_compression != "auto" ? options.exr_compression
                                  : loses_nothing(kept)             ? kept
                                                                    : "zip");
    // Where the plate says no time, OpenImageIO would write the time of day.
    if (!spec.find_attribute("DateTime")) spec.attribute("DateTime", "1970:01:01 00:00:00");
    spec.erase_attribute("openexr:lineOrder");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (!main_part) return;
    for (const auto& [name, text] : options.metadata)
        spec.attribute(name, text);
}

Status write_parts(const std::string& path, std::vector<Part>& parts) {
    const auto output = ImageOutput::create(path);
    if (!output) return tl::unexpected(cannot_write(path, OIIO::geterror()));
    std::vector<unsigned char> file;
    OIIO::Filesystem::IOVecOutput proxy(file);
    if (!output->set_ioproxy(&proxy)) return tl::unexpected(cannot_write(path, output->geterror()));
    std::vector<ImageSpec> specs;
    for (const Part& part : parts)
        specs.push_back(part.spec);
    const auto count = static_cast<int>(parts.size());
    bool ok = count == 1 ? output->open(path, specs[0]) : output->open(path, count, specs.data());
    for (int k = 0; ok && k < count; ++k) {
        Part& part = parts[static_cast<std::size_t>(k)];
        if (k > 0) ok = output->open(path, part.spec, ImageOutput::AppendSubimage);
        ok = ok && output->write_image(TypeDesc::UNKNOWN, part.bytes.data());
        part.bytes = {};
    }
    ok = ok && output->close();
    if (!ok) return tl::unexpected(cannot_write(path, output->geterror()));
    return write_file_atomically(path, std::as_bytes(std::span(file)));
}

Status write(const std::string& path, const ExrFrame& frame, const WriteOptions& options) {
    std::vector<Part> parts;
    std::size_t main = 0;
    std::array<int, 3> rgb{0, 1, 2};
    if (frame.source.empty()) {
        parts.push_back(fresh_part(frame, options.depth, options.pixel_aspect));
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
    parts[main] = picture_over(std::move(parts[main]), frame, rgb);
    for (std::size_t k = 0; k < parts.size(); ++k)
        finish_spec(parts[k].spec, options, k == main);
    return write_parts(path, parts);
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
