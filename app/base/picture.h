#pragma once
// Pictures for the screen: made by workers, uploaded and drawn by the window.

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

class ColorTransform;

/// A picture in Rec. 709 primaries: either 8-bit sRGB codes, or scene-linear IEEE halfs, where
/// values above 1 or finer than 8 bits matter. Immutable and shared.
struct Picture {
    std::uint64_t id = 0;  ///< Unique in this process: what textures are cached by.
    Size size;
    ImageU8x3 srgb;                ///< H×W×3, or empty.
    Image<std::uint16_t, 3> half;  ///< H×W×3, or empty.
    /// Red, green, blue of a pixel as the display encodes them; values above 1 stay.
    [[nodiscard]] Vec3 at(int x, int y) const;
    [[nodiscard]] std::size_t size_bytes() const { return srgb.size_bytes() + half.size_bytes(); }
};
using PicturePtr = std::shared_ptr<const Picture>;

/// A new number for Picture::id. Thread-safe.
[[nodiscard]] std::uint64_t next_picture_id();

/// `eight_bit`: the values fit sRGB codes. Otherwise `linear_from` takes them to linear light.
/// Null transforms mean: they are there already. Thread-safe.
[[nodiscard]] PicturePtr make_picture(const ImageF3& pixels, bool eight_bit,
                                      const ColorTransform* srgb_from,
                                      const ColorTransform* linear_from);
[[nodiscard]] PicturePtr make_picture(ImageU8x3 srgb);

/// The mean over blocks, so that the longer side is at most `longest` pixels.
[[nodiscard]] ImageU8x3 shrink(ViewU8x3 picture, int longest);
/// The picture as 8-bit sRGB codes, shrunk likewise.
[[nodiscard]] ImageU8x3 shrink(const Picture& picture, int longest);

[[nodiscard]] float half_to_float(std::uint16_t half);
[[nodiscard]] std::uint16_t float_to_half(float value);

}  // namespace weft
