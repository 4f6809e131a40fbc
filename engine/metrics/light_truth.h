#pragma once
// An estimated illumination compared with a true one.

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// One frame's agreement over the pixels inside of a matte.
struct ShadingAgreement {
    std::int64_t pixels = 0;
    /// Pearson's correlation of the two, linear light. Empty if either is constant.
    std::optional<double> correlation;
    /// Standard deviation of the true light, and mean |difference| after one overall gain (equal
    /// means), both as 8-bit display levels of a grey of 0.35 under it. The correlation is not
    /// informative if the former is no more than a level or two.
    double true_deviation_levels = 0, error_levels = 0;
};

/// Both in linear light, H×W; `inside` is 255 where pixels count. Values that are not finite or not
/// above 0 are ignored.
[[nodiscard]] ShadingAgreement compare_shading(ViewF1 estimated, ViewF1 truth, ViewU8x1 inside);

/// Shadow edges in a picture of light, compared with the true ones.
class ShadowEdges {
  public:
    /// Adds a frame. Both in linear light, H×W; profiles lie wholly where `inside` is 255.
    void add(ViewF1 result, ViewF1 truth, ViewU8x1 inside);
    struct Summary {
        std::int64_t edges = 0;    ///< Places at which a true edge was found.
        double width_ratio = 0;    ///< Median of the result's 10–90 % width over the true one's.
        double lag_px = 0;         ///< Median distance between the middles of both edges.
        double lag_p90_px = 0;     ///< The 90 % quantile of that distance.
        double missing_share = 0;  ///< Share of the true edges that the result does not show.
    };
    [[nodiscard]] Summary summary() const;

  private:
    std::vector<double> ratios_, lags_;
    std::int64_t found_ = 0;
};

}  // namespace weft
