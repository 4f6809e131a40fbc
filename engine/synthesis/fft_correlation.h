#pragma once
// Estimated placement costs for all translations by FFT, with an error bound.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/core/image.h"
#include "engine/synthesis/overlap_cost.h"
#include "engine/synthesis/plane_fft.h"

namespace weft {

/// A sample prepared for correlation with blocks. The block size and the translations are fixed by
/// the constructor. Thread-safe once constructed.
class FftCorrelation {
  public:
    /// `block` is the size of the blocks. Translations t run over [lo, hi] on each axis; t is the
    /// position of the sample's origin in the block.
    FftCorrelation(ViewU8x3 sample, Size block, Vec2i lo, Vec2i hi);
    ~FftCorrelation();
    FftCorrelation(const FftCorrelation&) = delete;
    FftCorrelation& operator=(const FftCorrelation&) = delete;

    /// Per translation, row by row: an estimate of OverlapCost::ssd, and the exact weight.
    struct Estimate {
        std::vector<double> ssd;
        std::vector<std::uint64_t> weight;
        double error = 0;  ///< Upper bound of |estimate − exact|.
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
    std::array<double, 4> norms_{};  ///< Euclidean lengths of the inputs of the spectra.
};

}  // namespace weft
