#pragma once
// How much of a texture's detail a result keeps (method.md, 7, "Sharpness kept").

#include <cstdint>

#include "engine/core/image.h"

namespace weft {

/// Detail of one picture, measured on N = Y / (local mean of Y + 4), which a smooth change of light
/// leaves unchanged. The local mean is a Gaussian of σ 8 px over the region alone.
struct Detail {
    double mean_laplacian = 0;  ///< Mean |N(left) + N(right) + N(up) + N(down) − 4 N|.
    double rms_contrast = 0;    ///< Standard deviation of N.
    std::int64_t pixels = 0;    ///< How many were measured.
};

/// `luma` in 8-bit units, H×W. `region` (255 = inside; below kInsideCoverage is outside) is eroded
/// by 4 px first. The picture's outermost pixels and values that are not finite are ignored.
[[nodiscard]] Detail measure_detail(ViewF1 luma, ViewU8x1 region);

/// Fewer pixels give no reliable measure of a texture.
inline constexpr std::int64_t kLeastDetailPixels = 200;

struct SharpnessKept {
    double laplacian = 0;  ///< 1 is right; below 0.95 is blur, above 1.08 is aliasing.
    double contrast = 0;   ///< The same of the RMS contrast.
    std::int64_t pixels = 0;
};

/// The detail of `result` divided by that of `ideal`, over the same region; all 0 (with pixels 0)
/// where fewer than kLeastDetailPixels can be measured or the ideal has no detail.
[[nodiscard]] SharpnessKept sharpness_kept(ViewF1 result, ViewF1 ideal, ViewU8x1 region);

}  // namespace weft
