#pragma once
// EXR frames that keep everything in their plate's file and may have further layers.

#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/media/frame_writer.h"

namespace weft {

/// Additional channels beside the picture, at its size.
struct ExrLayer {
    std::vector<std::string> channels;  ///< Full names: "patch.R".
    bool full_float = false;            ///< 32 bit instead of half.
    std::vector<float> samples;         ///< Interleaved, row by row, without gaps.
};

struct ExrFrame {
    ViewF3 rgb;
    ViewF1 alpha;  ///< May be empty. Not used with `source`, which has its own.
    /// The plate's EXR file, whose other channels and parts, data window, tiles, pixel aspect, time
    /// code and metadata are kept bit for bit; empty: none. If its depth differs from the requested
    /// one, the picture's own channels are converted.
    std::string source;
    std::string source_layer;  ///< The layer of `source` that `rgb` replaces.
    /// Where `rgb` differs from the plate: only these samples are written. Empty: everywhere. The
    /// data window then becomes the display window, because the pixels outside it are in another
    /// colour space.
    ViewU8x1 touched;
    /// A channel of an earlier pass that the source's part already has is replaced.
    std::vector<ExrLayer> layers;
};

/// Writes atomically, the picture with options.depth (kHalf or kFloat). Compression "auto" keeps
/// the source's if it is lossless, else uses "zip". Errors: as write_image(), Unreadable for a
/// source that cannot be read or is deep, and Usage for a layer with the name of one of the
/// picture's own channels.
[[nodiscard]] Status write_exr(const std::string& path, const ExrFrame& frame,
                               const WriteOptions& options);

/// Returns true if write_exr() can keep this file: an EXR whose `layer` has R, G and B.
[[nodiscard]] bool is_exr_with_colour(const std::string& path, const std::string& layer);

}  // namespace weft
