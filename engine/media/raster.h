#pragma once
// Internal: the samples of an image file, before they become a plate, a matte or a motion field.
// The only use of OpenImageIO and libpng for reading.

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "engine/core/alpha.h"
#include "engine/core/error.h"
#include "engine/core/geometry.h"
#include "engine/media/file_color.h"

namespace weft {

/// The sample format of the file. kOther is any other integer or double, read as float.
enum class SampleKind { kU8, kU16, kU32, kHalf, kFloat, kOther };

struct RasterInfo {
    Size size;                          ///< The display window, upright.
    SampleKind kind = SampleKind::kU8;  ///< Of the requested channels; the widest if mixed.
    double fps = 0;                     ///< 0 when the file does not say.
    double pixel_aspect = 1;            ///< Width of a pixel over its height.
    FileColor color = {};
    int orientation = 1;  ///< As stored in the file (orientation.h); already applied.
    /// Of a stereo EXR, the one that R, G and B belong to first; probe_raster() only.
    std::vector<std::string> views = {};
};

/// The aspect, or 1 for a value that no lens has.
inline double sane_pixel_aspect(double aspect) {
    return aspect > 0.05 && aspect < 20 ? aspect : 1.0;
}

/// Interleaved samples, `channels` per pixel, row by row without gaps. Half, float and other kinds
/// are stored as float, integers as their own codes.
struct Raster {
    RasterInfo info;
    int channels = 0;  ///< Colour channels (1 or 3), then alpha when there is one.
    bool has_alpha = false;
    AlphaKind alpha_kind = AlphaKind::kStraight;  ///< As the file declares it, or its format does.
    bool palette_indices = false;  ///< The samples of a palette file are indices, not colours.
    std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<std::uint32_t>,
                 std::vector<float>>
        samples;
    [[nodiscard]] int colors() const { return channels - (has_alpha ? 1 : 0); }
};

struct RasterRequest {
    std::string layer;    ///< "beauty" takes beauty.R, .G, .B, .A; empty: choose_channels().
    std::string channel;  ///< One channel by its full name, instead of a layer.
    /// Integer codes unchanged: palette indices instead of colours, and 1, 2 and 4 bits without
    /// scaling to 8.
    bool raw_codes = false;
    int part = -1;  ///< Only this part of an EXR; -1: the first that has it.
};

/// The part and channels of an EXR file that hold a layer's R, G and B.
struct ColourPlace {
    int part = 0;
    std::array<int, 3> rgb{};
};
/// Errors: Unreadable if the file is not an EXR or the layer lacks one of the three.
[[nodiscard]] Expected<ColourPlace> locate_colour(const std::string& path,
                                                  const std::string& layer);

/// Reads only the header. Errors: Unreadable, with the path, also if there is no such layer or
/// channel.
[[nodiscard]] Expected<RasterInfo> probe_raster(const std::string& path,
                                                const RasterRequest& request);
/// Errors: Unreadable (not an image, truncated, damaged, no such layer or channel: the message
/// lists the known ones), NoSpace if the picture exceeds decode_limit_bytes().
[[nodiscard]] Expected<Raster> read_raster(const std::string& path, const RasterRequest& request);

}  // namespace weft
