#pragma once
#include <array>

#include "engine/composite/grain.h"

namespace weft {

/// By lag, row by row, (0, 0) in the middle.
using GrainLags = std::array<double, GrainModel::kSide * GrainModel::kSide>;

struct GrainSpectrum {
    /// Turns white noise of deviation 1 into noise of deviation 1 with the grain's spectrum.
    std::array<float, GrainModel::kSide * GrainModel::kSide> kernel{};
    GrainLags correlation{};  ///< Of the grain; 1 in the middle.
};

/// `seen`: the measured autocorrelation. `lookup`: that of white noise after the sub-pixel lookup
/// of the measurement, whose loss of fine grain is undone.
[[nodiscard]] GrainSpectrum grain_spectrum(const GrainLags& seen, const GrainLags& lookup);

}  // namespace weft
