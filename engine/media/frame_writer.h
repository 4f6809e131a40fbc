#pragma once
// Writing results: every file appears whole or not at all (temporary name, fsync, rename).

#include <memory>
#include <optional>
#include <string>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/media/frame_reader.h"

namespace weft {

struct WriteOptions {
    PixelDepth depth = PixelDepth::kU8;     ///< PNG, TIFF: U8 or U16; JPEG: U8; EXR: half or float.
    int jpeg_quality = 95;                  ///< 4:4:4
    std::string exr_compression = "zip";
};

/// The depth to write when the user did not say: the plate's own where the format can hold it
/// (PNG/TIFF for U8 and U16, EXR for half and float), else the nearest that can.
[[nodiscard]] PixelDepth default_depth(const std::string& path, PixelDepth plate);
/// Errors: Usage when the extension is unknown or cannot hold this depth.
[[nodiscard]] Status check_format(const std::string& path, const WriteOptions& options);

/// Rounds to the nearest code (half up) once, clamps integers to their range, writes to a temporary
/// name beside `path`, and renames it. `alpha` may be empty. Errors: NoSpace (disk full, quota),
/// Unreadable (folder missing or not writable). On error no file of either name remains.
[[nodiscard]] Status write_image(const std::string& path, ViewF3 rgb, ViewF1 alpha, const WriteOptions& options);
[[nodiscard]] Status write_matte(const std::string& path, ViewU8x1 matte);

/// Removes what a killed run may have left: temporary names of write_image() in the folder of `path`.
void remove_stale_temporaries(const std::string& path);

/// A review movie: .mp4 (H.264 where the build has it, else MPEG-4) or .mkv (FFV1, lossless 8 bit).
/// Frames go to a temporary name; close() renames it. Destroyed without close(): nothing remains.
class MovieWriter {
  public:
    virtual ~MovieWriter() = default;
    [[nodiscard]] virtual Status add(ViewF3 display_rgb) = 0;  ///< sRGB-encoded [0, 1].
    [[nodiscard]] virtual Status close() = 0;
};
[[nodiscard]] Expected<std::unique_ptr<MovieWriter>> open_movie(const std::string& path, Size size, double fps);

}  // namespace weft
