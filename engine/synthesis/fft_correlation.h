#pragma once
// Estimated placement costs for all translations at once, by FFT, with a bound of their error.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/core/image.h"
#include "engine/synthesis/overlap_cost.h"
#include "engine/synthesis/plane_fft.h"

namespace weft {

/// A sample prepared for correlation with blocks; blocks and the translations asked for are bounded
/// when it is made. Thread-safe once made.
class FftCorrelation {
  public:
    /// `block` is the size of the blocks; translations t run over [lo, hi] on each axis, where
    /// t is where the sample's origin lies in the block.
    FftCorrelation(ViewU8x3 sample, Size block, Vec2i lo, Vec2i hi);
    ~FftCorrelation();
    FftCorrelation(const FftCorrelation&) = delete;
    FftCorrelation& operator=(const FftCorrelation&) = delete;

    /// Per translation, row by row: an estimate of OverlapCost::ssd, and the exact weight.
    struct Estimate {
        std::vector<double> ssd;
        std::vector<std::uint64_t> weight;
        double error = 0;  ///< |estimate − exact| is never larger.
    };
    [[nodiscard]] Estimate estimate(const MatchTarget& target) const;

  private:
    struct Weighted;

    [[nodiscard]] Weighted weigh(const MatchTarget& target, float* planes) const;
    [[nodiscard]] double error_bound(const Weighted& block) const;
    void correlate(const float* planes, float* out) const;

    std::unique_ptr<PlaneFft> fft_;
    Size sample_size_, block_;
    Vec2i lo_, hi_;
    std::array<int, 3> mean_{};
    /// Of channels 0…2 less their mean, and of their squared length.
    std::array<std::vector<FftLanes>, 4> spectra_;
    std::array<double, 4> norms_{};  ///< Euclidean lengths of what the spectra are of.
};

}  // namespace weft
