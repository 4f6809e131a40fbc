#pragma once
// What a sample is: a texture without order, a periodic one, or one picture.

#include <string>

#include "engine/core/image.h"
#include "engine/synthesis/sample_lattice.h"

namespace weft {

enum class SampleKind {
    kStochastic,  ///< Alike everywhere, without a period.
    kPeriodic,    ///< Repeats on a lattice.
    kPicture      ///< Shows its middle or its halves otherwise than the rest: not a texture.
};

struct SampleDescription {
    SampleKind kind = SampleKind::kStochastic;
    SampleLattice lattice;  ///< Of a periodic sample.
    /// Variance in the outer eighth over that inside: near 0 for an object or a print on a ground.
    double border = 1;
    /// Share of the variance of large areas that follows the distance from the middle, and how far
    /// the corners differ from the middle in standard deviations: a vignette.
    double radial = 0, fall = 0;
    /// Share of the variance between the four quarters.
    double uneven = 0;
};

/// Deterministic and thread-safe.
[[nodiscard]] SampleDescription describe_sample(ViewU8x3 sample);
/// "periodic", "stochastic" or "picture".
[[nodiscard]] const char* kind_name(SampleKind kind);
/// What it was taken for and why, as one sentence without a full stop.
[[nodiscard]] std::string reason_of(const SampleDescription& sample);

}  // namespace weft
