#pragma once
// Internal: converts pixels to and from a movie's frames.

#include <memory>
#include <string>

#include "engine/core/image.h"
#include "engine/media/raster.h"
#include "engine/media/video_library.h"

struct SwsContext;

namespace weft {

/// Fills a frame of AV_PIX_FMT_YUV420P by the BT.709 matrix in limited range, with chroma sited
/// left (the default of H.264), or one of AV_PIX_FMT_BGR0. Values are clamped to [0, 1], NaN
/// becomes 0, and each is rounded once. If the frame is larger than the picture, the last column
/// and row are repeated. The same for any number of threads.
void fill_yuv420_bt709(ViewF3 display_rgb, AVFrame& frame);
void fill_bgr0(ViewF3 display_rgb, AVFrame& frame);

/// Converts decoded frames to interleaved RGB(A) codes: 8 bit, or 16 bit for deeper sources.
/// Matrix, range and chroma position come from the frame's tags; without a tag BT.709 for pictures
/// larger than standard definition (wider than 1024 or higher than 576 pixels), else BT.601;
/// limited range; chroma on the left. The same for any number of threads. Not thread-safe.
class MovieConverter {
  public:
    MovieConverter();
    ~MovieConverter();
    /// Also rotates the picture clockwise by `rotation_deg` (a multiple of 90). Null if the sample
    /// format is not supported.
    [[nodiscard]] std::shared_ptr<const Raster> convert(const AVFrame& frame, int rotation_deg);

  private:
    struct Setup;
    struct FreeScaler {
        void operator()(SwsContext* scaler) const;
    };
    bool prepare(const AVFrame& frame);

    std::unique_ptr<Setup> setup_;
    std::unique_ptr<SwsContext, FreeScaler> scaler_;
    AvFrame working_;  // what swscale gives: RGB codes, or Y'CbCr without subsampling
};

}  // namespace weft
