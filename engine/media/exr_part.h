#pragma once
// Internal: a part of an EXR file in memory, on its way from a plate into a frame.

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

/// Stores a number in a channel's own format, as the nearest that it holds; NaN and infinity stay.
void store_sample(unsigned char* to, OIIO::TypeDesc format, float value);

/// The number of the channel of this name; -1 where there is none.
[[nodiscard]] int channel_named(const OIIO::ImageSpec& spec, const std::string& name);

/// The channels `rgb`, and the alpha beside them, as half or float where all three are of the
/// other.
[[nodiscard]] ExrPart with_depth(ExrPart part, const std::array<int, 3>& rgb, PixelDepth depth);
/// Another data window; what the part had not is 0.
[[nodiscard]] ExrPart with_window(ExrPart part, const Recti& window);
/// The layers' channels as well, all of 0. Those that the part has already, of an earlier pass,
/// take the new layer's depth and lose their samples.
[[nodiscard]] ExrPart with_channels(ExrPart part, const std::vector<ExrLayer>& layers);

}  // namespace weft
