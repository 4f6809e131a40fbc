#pragma once
// Images for display: made by workers, uploaded and drawn by the window.

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

class ColorTransform;

/// An image in Rec. 709 primaries: 8-bit sRGB codes, or scene-linear half floats where values above
/// 1 or finer than 8 bits matter. Immutable and shared.
struct Picture {
    std::uint64_t id = 0;  ///< Unique in this process; the key of the texture cache.
    Size size;
    ImageU8x3 srgb;                ///< H×W×3, or empty.
    Image<std::uint16_t, 3> half;  ///< H×W×3, or empty.
    /// Red, green and blue of a pixel, display-encoded; values above 1 are kept.
    [[nodiscard]] Vec3 at(int x, int y) const;
    [[nodiscard]] std::size_t size_bytes() const { return srgb.size_bytes() + half.size_bytes(); }
};
using PicturePtr = std::shared_ptr<const Picture>;

/// Returns a new Picture::id. Thread-safe.
[[nodiscard]] std::uint64_t next_picture_id();

/// `eight_bit`: the values fit sRGB codes. Otherwise `linear_from` converts them to linear light. A
/// null transform means that the values are already in that space. Thread-safe.
[[nodiscard]] PicturePtr make_picture(const ImageF3& pixels, bool eight_bit,
                                      const ColorTransform* srgb_from,
                                      const ColorTransform* linear_from);
[[nodiscard]] PicturePtr make_picture(ImageU8x3 srgb);

/// Box-filters the picture so that its longer side is at most `longest` pixels.
[[nodiscard]] ImageU8x3 shrink(ViewU8x3 picture, int longest);
/// Returns the picture as 8-bit sRGB codes, shrunk in the same way.
[[nodiscard]] ImageU8x3 shrink(const Picture& picture, int longest);

[[nodiscard]] float half_to_float(std::uint16_t half);
[[nodiscard]] std::uint16_t float_to_half(float value);

}  // namespace weft
