#pragma once
// Internal: pictures as bytes, without loss.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// PNG, RGB in that order. Thread-safe.
[[nodiscard]] std::vector<std::byte> encode_png(ViewU8x3 image);
/// JPEG of quality 92, for originals, which are only looked at. Thread-safe.
[[nodiscard]] std::vector<std::byte> encode_jpeg(ViewU8x3 image);
/// PNG or JPEG. Errors: Unreadable. Pictures of more than 64 megapixels are refused before they are
/// decoded.
[[nodiscard]] Expected<ImageU8x3> decode_picture(std::span<const std::byte> bytes);

/// 32 hexadecimal digits: the hash of size and pixels.
[[nodiscard]] std::string texture_id(const ImageU8x3& pixels);

/// Averages over areas when it gets smaller; bicubic when it gets larger.
[[nodiscard]] ImageU8x3 resized(ViewU8x3 image, Size size);
[[nodiscard]] ImageU8x3 cropped(ViewU8x3 image, const Recti& r);

}  // namespace weft
