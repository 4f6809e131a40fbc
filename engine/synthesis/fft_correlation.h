#pragma once
// Estimated placement costs for all translations at once, by FFT, with a bound of their error.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/core/image.h"
#include "engine/synthesis/overlap_cost.h"

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
    struct Plans;
    struct Weighted;
    using Spectrum = std::unique_ptr<float[], void (*)(void*)>;

    [[nodiscard]] Weighted weigh(const MatchTarget& target) const;
    void correlate(std::vector<Spectrum>& data) const;

    std::unique_ptr<Plans> plans_;
    Size sample_size_, block_, fft_;
    Vec2i lo_, hi_;
    std::array<int, 3> mean_{};
    std::vector<Spectrum> spectra_;  ///< Channels 0…2 less their mean, and their squared length.
    std::array<double, 4> norms_{};  ///< Euclidean lengths of what the spectra are of.
};

}  // namespace weft
