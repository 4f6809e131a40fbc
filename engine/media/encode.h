#pragma once
// Internal: encodes samples into an image file, whole or not at all. The only use of OpenImageIO
// for writing.

#include <string>

#include "engine/core/error.h"
#include "engine/media/frame_writer.h"
#include "engine/media/raster.h"

namespace weft {

/// Interleaved rows without gaps. kHalf is passed as float and stored as half. Channels: grey, RGB
/// or RGBA.
struct Samples {
    Size size;
    int channels = 0;
    SampleKind kind = SampleKind::kU8;
    const void* data = nullptr;
    AlphaKind alpha = AlphaKind::kStraight;  ///< What a TIFF is tagged with.
};

/// Encodes by the extension of `path` and writes atomically. Errors: as write_image().
[[nodiscard]] Status write_samples(const std::string& path, const Samples& samples,
                                   const WriteOptions& options);

}  // namespace weft
