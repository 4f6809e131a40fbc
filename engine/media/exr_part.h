#pragma once
// Internal: a part of an EXR file in memory, between a plate and a frame.

#include <OpenImageIO/imageio.h>

#include <array>
#include <string>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/media/exr_frame.h"

namespace weft {

/// Native samples of every channel, interleaved, over the part's data window.
struct ExrPart {
    OIIO::ImageSpec spec;
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

/// Stores a number in a channel's own format, rounded to the nearest; NaN and infinity stay.
void store_sample(unsigned char* to, OIIO::TypeDesc format, float value);

/// The index of the channel of this name; -1 if there is none.
[[nodiscard]] int channel_named(const OIIO::ImageSpec& spec, const std::string& name);

/// Converts the channels `rgb`, and the alpha beside them, to half or float if all three have the
/// other depth.
[[nodiscard]] ExrPart with_depth(ExrPart part, const std::array<int, 3>& rgb, PixelDepth depth);
/// Sets another data window; new pixels are 0.
[[nodiscard]] ExrPart with_window(ExrPart part, const Recti& window);
/// Adds the layers' channels, all 0. Channels of an earlier pass that the part already has take the
/// new layer's depth and lose their samples.
[[nodiscard]] ExrPart with_channels(ExrPart part, const std::vector<ExrLayer>& layers);

}  // namespace weft
