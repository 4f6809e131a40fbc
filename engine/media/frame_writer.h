#pragma once
// Writes results. Every file appears whole or not at all (temporary name, fsync, rename), only if
// its WriteRule allows it, and only after its header was read back and matches.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/media/atomic_file.h"  // WriteRule, remove_stale_temporaries()
#include "engine/media/frame_reader.h"

namespace weft {

struct WriteOptions {
    /// PNG: U8 or U16; TIFF: U8, U16 or float; JPEG: U8; EXR: half or float; DPX: U8 or U16.
    PixelDepth depth = PixelDepth::kU8;
    int jpeg_quality = 95;  ///< 4:4:4
    std::string exr_compression =
        "zip";             ///< auto (zip), none, rle, zip, zips, piz, pxr24, b44, b44a, dwaa, dwab
    int dpx_bits = 10;     ///< A U16 DPX holds 10 bits (the film standard), 12 or 16.
    bool dpx_log = false;  ///< The values are film log ("cineon"); a DPX says so in its header.
    /// Width of a pixel over its height; empty: as in the header of an EXR that is written over
    /// another one, else 1.
    std::optional<double> pixel_aspect = {};
    /// Entries of the file's header (engine/media/metadata.h).
    std::vector<std::pair<std::string, std::string>> metadata = {};
    /// The plate's file. A DPX keeps the shot's data of its header: time code, key code, frame
    /// rate, position in the sequence, camera. Empty, or not a DPX: none.
    std::string source = {};
    AlphaKind alpha = AlphaKind::kStraight;  ///< Of the colours to write; unused without an alpha.
    WriteRule rule = {};
};

/// The default depth: the plate's own if the format supports it (PNG/TIFF for U8 and U16, EXR for
/// half and float, TIFF for float), else the nearest: PNG and DPX store half and float as U16, TIFF
/// stores half as float, EXR stores U8 as half (its codes survive) and U16 as float, JPEG stores
/// all as U8.
[[nodiscard]] PixelDepth default_depth(const std::string& path, PixelDepth plate);
/// Errors: Usage if the extension is unknown or does not support this depth.
[[nodiscard]] Status check_format(const std::string& path, const WriteOptions& options);

/// Rounds to the nearest code (half up) once, clamps integers to their range, writes to a temporary
/// name beside `path`, and renames it. NaN becomes 0 in an integer file; a finite value beyond the
/// range of half becomes the largest half, and infinity stays. `alpha` may be empty. With one, the
/// colours are written as the format holds them, converted from options.alpha: straight in a PNG,
/// associated in an EXR or DPX, as options.source is tagged in a TIFF (straight if that is no
/// TIFF), over black in a JPEG, which has no alpha. The file does not depend on the time, so the
/// same pixels give the same bytes. Errors: Usage (see check_format, and options.rule), NoSpace
/// (disk full, quota), Unreadable (folder missing or not writable), RenderFailed (the file reads
/// back differently). After an error there is no new file, and an older one at `path` is unchanged.
[[nodiscard]] Status write_image(const std::string& path, ViewF3 rgb, ViewF1 alpha,
                                 const WriteOptions& options);
/// Coverage as 8-bit grey: PNG or TIFF (Usage for JPEG, which would blur it). Errors: as
/// write_image().
[[nodiscard]] Status write_matte(const std::string& path, ViewU8x1 matte,
                                 const WriteRule& rule = {});

/// A review movie: .mp4 (H.264 if the machine has x264, else MPEG-4; BT.709 matrix, limited range,
/// 4:2:0, tagged, index in front) or .mkv (FFV1, lossless 8-bit RGB of any size). An .mp4 has even
/// sizes: an odd picture's last column or row is repeated. Frames go to a temporary file; close()
/// renames it. Destruction without close(), or after an error, leaves no file. The same frames give
/// the same bytes for any number of threads. Not thread-safe.
class MovieWriter {
  public:
    virtual ~MovieWriter() = default;
    /// sRGB-encoded, clamped to [0, 1]. Errors: Usage for another size; NoSpace if the disk is
    /// full, then or a few frames later, at the latest from close().
    [[nodiscard]] virtual Status add(ViewF3 display_rgb) = 0;
    /// Errors: NoSpace; RenderFailed if no frame was added, the encoder wrote nothing, or the movie
    /// reads back with another size or number of frames; Usage by the rule.
    [[nodiscard]] virtual Status close() = 0;
};
/// `fps`: 0.01 to 1000; 23.976, 29.97 and their multiples become 24000/1001 and so on. Errors:
/// Usage (extension, empty size, frame rate, the rule), Unreadable (the folder, or no encoder for
/// this size), NoSpace.
[[nodiscard]] Expected<std::unique_ptr<MovieWriter>> open_movie(const std::string& path, Size size,
                                                                double fps, double pixel_aspect = 1,
                                                                const WriteRule& rule = {});

}  // namespace weft
