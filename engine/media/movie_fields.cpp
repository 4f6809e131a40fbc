#include "engine/media/movie_fields.h"

extern "C" {
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace weft {
namespace {

constexpr int kColumns = 480;  // that are looked at, at most
// Frames that are looked at: all of the beginning, then some in a row, again and again.
constexpr int kBeginning = 96, kEvery = 250, kInARow = 16;

// The upper 8 bits of the first component, luma or red; empty where it cannot be read so.
Matte luma_codes(const AVFrame& frame) {
    const AVPixFmtDescriptor* format =
        av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
    constexpr std::uint64_t kOther = AV_PIX_FMT_FLAG_HWACCEL | AV_PIX_FMT_FLAG_BITSTREAM |
                                     AV_PIX_FMT_FLAG_PAL | AV_PIX_FMT_FLAG_BE |
                                     AV_PIX_FMT_FLAG_FLOAT;
    if (!format || (format->flags & kOther) != 0) return {};
    const AVComponentDescriptor& component = format->comp[0];
    const int bits = component.depth;
    if (bits < 8 || bits > 16 || !frame.data[component.plane]) return {};
    const int step = std::max(1, frame.width / kColumns);
    Matte out(frame.width / step, frame.height);
    for (int y = 0; y < out.height(); ++y) {
        const std::uint8_t* line =
            frame.data[component.plane] +
            static_cast<std::ptrdiff_t>(y) * frame.linesize[component.plane] + component.offset;
        for (int x = 0; x < out.width(); ++x) {
            const std::uint8_t* sample =
                line + static_cast<std::ptrdiff_t>(x) * step * component.step;
            if (bits == 8) {
                out.at(x, y) = *sample;
                continue;
            }
            std::uint16_t wide = 0;
            std::memcpy(&wide, sample, sizeof wide);
            out.at(x, y) = static_cast<std::uint8_t>(wide >> component.shift >> (bits - 8));
        }
    }
    return out;
}

}  // namespace

void MovieFields::add(const AVFrame& frame) {
    flagged_ = flagged_ || frame.interlaced_frame != 0;
    const int number = frames_++;
    if (number >= kBeginning && number % kEvery >= kInARow) {
        meter_.skip();
        return;
    }
    meter_.add(luma_codes(frame));
}

bool MovieFields::are_interlaced() const {
    return meter_.fields(flagged_) == Fields::kInterlaced;
}

}  // namespace weft
