#pragma once
// Internal: encodes and decodes stored pictures.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// PNG, RGB in that order. Thread-safe.
[[nodiscard]] std::vector<std::byte> encode_png(ViewU8x3 image);
/// JPEG of quality 92, for originals, which are only for viewing. Thread-safe.
[[nodiscard]] std::vector<std::byte> encode_jpeg(ViewU8x3 image);
/// PNG or JPEG. Errors: Unreadable, also for more than 64 megapixels, before decoding.
[[nodiscard]] Expected<ImageU8x3> decode_picture(std::span<const std::byte> bytes);

/// 32 hexadecimal digits: the hash of size and pixels.
[[nodiscard]] std::string texture_id(const ImageU8x3& pixels);

/// Area average if it gets smaller, bicubic if it gets larger.
[[nodiscard]] ImageU8x3 resized(ViewU8x3 image, Size size);
[[nodiscard]] ImageU8x3 cropped(ViewU8x3 image, const Recti& r);

}  // namespace weft
