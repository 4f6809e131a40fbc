#pragma once
// Internal: pixels on their way into and out of a movie's frames.

#include <memory>
#include <string>

#include "engine/core/image.h"
#include "engine/media/raster.h"
#include "engine/media/video_library.h"

struct SwsContext;

namespace weft {

/// Fills a frame of AV_PIX_FMT_YUV420P by the BT.709 matrix in limited range, its chroma sited left
/// (as H.264 has it unless it says otherwise), or one of AV_PIX_FMT_BGR0. Values are clamped to
/// [0, 1], NaN is 0, and each is rounded once. Where the frame is larger than the picture, the last
/// column and row are repeated. Independent of the number of threads.
void fill_yuv420_bt709(ViewF3 display_rgb, AVFrame& frame);
void fill_bgr0(ViewF3 display_rgb, AVFrame& frame);

/// Decoded frames → interleaved RGB(A) codes: 8 bit, or 16 bit for deeper sources. The matrix,
/// range and chroma position are those that the frame is tagged with; without a tag BT.709 for
/// pictures larger than standard definition (wider than 1024 or higher than 576 pixels), else
/// BT.601; limited range; chroma on the left. Independent of the number of threads. One thread
/// calls.
class MovieConverter {
  public:
    MovieConverter();
    ~MovieConverter();
    /// Turns the picture clockwise by `rotation_deg` (a multiple of 90) on the way. Null when the
    /// samples are of a kind that cannot be converted.
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
