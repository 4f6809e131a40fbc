#pragma once
// Temporal Illumination Variance (method.md, 7).

#include <cstdint>
#include <optional>

#include "engine/core/image.h"

namespace weft {

/// Mean over the region (`matte` ≥ kInsideCoverage) of V = max(R, G, B) of encoded values, in 8-bit
/// units. Empty if no pixel inside is finite. Both H×W.
[[nodiscard]] std::optional<double> mean_value(ViewF3 encoded, ViewU8x1 matte);

/// Collects one pair of means per frame; remembers sums only.
class IlluminationVariance {
  public:
    /// mean_value() of the result and of the source in one frame.
    void add(double result_mean, double source_mean);
    /// Variance over time of the region's mean V, squared 8-bit units.
    [[nodiscard]] double tiv() const;
    [[nodiscard]] double source_tiv() const;
    /// Variance over time of r_t / mean(r) − s_t / mean(s), without a unit: 0 when the result
    /// brightens and darkens exactly as the source does. 0 when either mean is 0.
    [[nodiscard]] double tiv_relative() const;
    [[nodiscard]] std::int64_t frames() const { return frames_; }

  private:
    // Welford's running means and (co)moments: exact enough for any number of frames.
    std::int64_t frames_ = 0;
    double mean_r_ = 0, mean_s_ = 0, m_rr_ = 0, m_ss_ = 0, m_rs_ = 0;
};

}  // namespace weft
