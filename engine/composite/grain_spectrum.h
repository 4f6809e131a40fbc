#pragma once
#include <array>

#include "engine/composite/grain.h"

namespace weft {

/// By lag, row by row, (0, 0) in the middle.
using GrainLags = std::array<double, GrainModel::kSide * GrainModel::kSide>;

struct GrainSpectrum {
    /// White noise of deviation 1 under it has deviation 1 and the grain's spectrum.
    std::array<float, GrainModel::kSide * GrainModel::kSide> kernel{};
    GrainLags correlation{};  ///< Of the grain; 1 in the middle.
};

/// `seen`: autocorrelation of what was measured; `lookup`: that of white noise after the lookup
/// between pixels through which it was measured, whose loss of fine grain is undone.
[[nodiscard]] GrainSpectrum grain_spectrum(const GrainLags& seen, const GrainLags& lookup);

}  // namespace weft
