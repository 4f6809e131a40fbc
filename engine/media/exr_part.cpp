#include "engine/media/exr_part.h"

#include <OpenImageIO/half.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace weft {
namespace {

using OIIO::ImageSpec;
using OIIO::TypeDesc;

float sample_at(const unsigned char* from, TypeDesc format) {
    if (format.basetype == TypeDesc::HALF) {
        half h;
        std::memcpy(&h, from, sizeof h);
        return h;
    }
    if (format.basetype == TypeDesc::FLOAT) {
        float value = 0;
        std::memcpy(&value, from, sizeof value);
        return value;
    }
    std::uint32_t n = 0;
    std::memcpy(&n, from, sizeof n);
    return static_cast<float>(n);
}

}  // namespace

void store_sample(unsigned char* to, TypeDesc format, float value) {
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

int channel_named(const ImageSpec& spec, const std::string& name) {
    const auto at = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
    return at == spec.channelnames.end() ? -1 : static_cast<int>(at - spec.channelnames.begin());
}

ExrPart with_depth(ExrPart part, const std::array<int, 3>& rgb, PixelDepth depth) {
    if (depth != PixelDepth::kHalf && depth != PixelDepth::kFloat) return part;
    const TypeDesc wanted = depth == PixelDepth::kFloat ? TypeDesc::FLOAT : TypeDesc::HALF;
    std::vector<int> picture(rgb.begin(), rgb.end());
    const std::string& red = part.spec.channelnames[static_cast<std::size_t>(rgb[0])];
    const std::string alpha = red.substr(0, red.rfind('.') + 1) + "A";
    if (const int at = channel_named(part.spec, alpha); at >= 0) picture.push_back(at);
    const TypeDesc other = depth == PixelDepth::kFloat ? TypeDesc::HALF : TypeDesc::FLOAT;
    // Channels of mixed depths, and integer channels, stay as they are.
    if (!std::all_of(rgb.begin(), rgb.end(),
                     [&](int c) { return part.spec.channelformat(c) == other; }))
        return part;
    ExrPart out;
    out.spec = part.spec;
    out.spec.channelformats.clear();
    for (int c = 0; c < part.spec.nchannels; ++c) {
        const bool own = std::find(picture.begin(), picture.end(), c) != picture.end();
        out.spec.channelformats.push_back(own ? wanted : part.spec.channelformat(c));
    }
    const auto pixels =
        static_cast<std::size_t>(part.spec.width) * static_cast<std::size_t>(part.spec.height);
    const std::size_t was = part.pixel_bytes(), is = out.pixel_bytes();
    out.bytes.resize(is * pixels);
    for (int c = 0; c < part.spec.nchannels; ++c) {
        const TypeDesc from = part.spec.channelformat(c), to = out.spec.channelformat(c);
        const unsigned char* source = part.bytes.data() + part.offset_of(c);
        unsigned char* target = out.bytes.data() + out.offset_of(c);
        for (std::size_t i = 0; i < pixels; ++i, source += was, target += is) {
            if (from == to)
                std::memcpy(target, source, from.size());
            else
                store_sample(target, to, sample_at(source, from));
        }
    }
    return out;
}

ExrPart with_window(ExrPart part, const Recti& window) {
    if (window == part.window()) return part;
    ExrPart out;
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

// OpenImageIO would call a second channel of one name "channel19".
ExrPart with_channels(ExrPart part, const std::vector<ExrLayer>& layers) {
    if (layers.empty()) return part;
    const int before = part.spec.nchannels;
    ExrPart out;
    out.spec = part.spec;
    if (out.spec.channelformats.empty())
        out.spec.channelformats.assign(static_cast<std::size_t>(before), part.spec.format);
    std::vector<bool> kept(static_cast<std::size_t>(before), true);
    for (const ExrLayer& layer : layers) {
        const TypeDesc format = layer.full_float ? TypeDesc::FLOAT : TypeDesc::HALF;
        for (const std::string& name : layer.channels) {
            if (const int at = channel_named(part.spec, name); at >= 0) {
                kept[static_cast<std::size_t>(at)] = false;
                out.spec.channelformats[static_cast<std::size_t>(at)] = format;
                continue;
            }
            out.spec.channelnames.push_back(name);
            out.spec.channelformats.push_back(format);
            ++out.spec.nchannels;
        }
    }
    const auto pixels =
        static_cast<std::size_t>(part.spec.width) * static_cast<std::size_t>(part.spec.height);
    const std::size_t was = part.pixel_bytes(), is = out.pixel_bytes();
    out.bytes.assign(is * pixels, 0);
    for (int c = 0; c < before; ++c) {
        if (!kept[static_cast<std::size_t>(c)]) continue;
        const std::size_t from = part.offset_of(c), to = out.offset_of(c);
        const std::size_t bytes = part.spec.channelformat(c).size();
        for (std::size_t i = 0; i < pixels; ++i)
            std::memcpy(out.bytes.data() + i * is + to, part.bytes.data() + i * was + from, bytes);
    }
    return out;
}

}  // namespace weft
