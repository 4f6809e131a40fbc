#pragma once
// EXR frames that keep all that their plate's file holds, and may carry further layers.

#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/media/frame_writer.h"

namespace weft {

/// Further channels beside the picture, at its size.
struct ExrLayer {
    std::vector<std::string> channels;  ///< Full names: "patch.R".
    bool full_float = false;            ///< 32 bit instead of half.
    std::vector<float> samples;         ///< Interleaved, row by row, without gaps.
};

struct ExrFrame {
    ViewF3 rgb;
    ViewF1 alpha;  ///< May be empty. Not used with `source`, which has its own.
    /// The plate's EXR file, whose other channels and parts, data window, tiles, pixel aspect, time
    /// code and metadata are kept bit for bit; empty: none. Of another depth than the one asked
    /// for, the picture's own channels are converted.
    std::string source;
    std::string source_layer;  ///< The layer of it that `rgb` stands for.
    /// Where `rgb` differs from the plate: only there are samples written. Empty: everywhere, and
    /// then the data window becomes the display window, since what lies outside is in another
    /// colour space.
    ViewU8x1 touched;
    /// A channel that the source's part has already, of an earlier pass, is replaced.
    std::vector<ExrLayer> layers;
};

/// Writes atomically, the picture with options.depth (kHalf or kFloat). With the
/// compression "auto" the source's is kept where it loses nothing, else "zip" is used. Errors: as
/// write_image(), Unreadable for a source that cannot be read or is deep, and Usage for a layer
/// with the name of one of the picture's own channels.
[[nodiscard]] Status write_exr(const std::string& path, const ExrFrame& frame,
                               const WriteOptions& options);

/// Whether a frame of this path would be read and kept by write_exr(): it is an EXR whose `layer`
/// has R, G and B.
[[nodiscard]] bool is_exr_with_colour(const std::string& path, const std::string& layer);

}  // namespace weft
