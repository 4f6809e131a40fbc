#pragma once
// Movies with codes, formats and tags of the test's choice, and what a movie's tags say.

extern "C" {
#include <libavutil/pixfmt.h>
#include <libavutil/rational.h>
}

#include <array>
#include <string>
#include <vector>

#include "engine/core/geometry.h"

namespace weft {

struct CodedMovie {
    AVPixelFormat format = AV_PIX_FMT_YUV420P;
    Size size{64, 64};
    AVColorSpace matrix = AVCOL_SPC_UNSPECIFIED;
    AVColorRange range = AVCOL_RANGE_UNSPECIFIED;
    AVColorTransferCharacteristic transfer = AVCOL_TRC_UNSPECIFIED;
    int rotation_deg = 0;  ///< Clockwise; QuickTime (.mov) only.
    bool interlaced = false;
    std::string encoder = {};    ///< By FFmpeg's name; empty: FFV1. Another may not be there.
    std::vector<int> stamps{0};  ///< When each frame is shown, in 24ths of a second.
};

/// Codes of the components in the order of the format's description: Y, Cb, Cr or R, G, B, A.
using Codes = std::array<int, 4>;

[[nodiscard]] bool has_encoder(const std::string& name);

/// Frames of equal vertical bars, each filled with its codes; FFV1 keeps them.
void write_bars(const std::string& path, const CodedMovie& movie, const std::vector<Codes>& bars);
/// The same with bars of its own for each frame, of which `movie` has as many stamps.
void write_frames(const std::string& path, const CodedMovie& movie,
                  const std::vector<std::vector<Codes>>& frames);

struct MovieTags {
    std::string codec;
    AVColorSpace matrix = AVCOL_SPC_UNSPECIFIED;
    AVColorRange range = AVCOL_RANGE_UNSPECIFIED;
    AVColorPrimaries primaries = AVCOL_PRI_UNSPECIFIED;
    AVColorTransferCharacteristic transfer = AVCOL_TRC_UNSPECIFIED;
    AVRational fps{};
};
MovieTags tags_of(const std::string& path);

}  // namespace weft
