#pragma once
// Internal: parts of texture_features(). Planes are rows of floats without gaps; each part appends
// to `out`.

#include <span>
#include <vector>

namespace weft {

/// Deviation, skewness and kurtosis of a plane, its mean before them if wanted. `width`: a multiple
/// of 8.
void add_moments(std::span<const float> plane, int width, bool with_mean, std::vector<float>& out);

/// Pearson's, of two planes of one size.
[[nodiscard]] double correlation(std::span<const float> x, std::span<const float> y);

/// Of a 96×96 plane: energies by scale and orientation, their unevenness over the sample, what is
/// left of them when it is turned, and how energies of neighbouring scales go together (Portilla &
/// Simoncelli 2000).
void add_oriented_energies(std::span<const float> plane, std::vector<float>& out);

/// Of a 96×96 plane: autocorrelation by radius (mean, lowest, highest over the angles).
void add_repetition(std::span<const float> plane, std::vector<float>& out);

}  // namespace weft
