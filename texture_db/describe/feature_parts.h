#pragma once
// Internal: parts of texture_features(). Planes are rows of floats without gaps; each part appends
// to `out`.

#include <span>
#include <vector>

namespace cv {
class Mat;
}

namespace weft {

inline constexpr int kDescribedSide = 96;  ///< Of a sample that is described, px.

[[nodiscard]] std::span<const float> values_of(const cv::Mat& plane);

/// Standard deviation, skewness and kurtosis of a plane, preceded by its mean if wanted. `width`: a
/// multiple of 8.
void add_moments(std::span<const float> plane, int width, bool with_mean, std::vector<float>& out);

/// Pearson's correlation of two planes of one size.
[[nodiscard]] double correlation(std::span<const float> x, std::span<const float> y);

/// Of a 96×96 plane: energies by scale and orientation, their variation over the sample, their
/// rotation-invariant form, and how energies of neighbouring scales correlate (Portilla &
/// Simoncelli 2000).
void add_oriented_energies(std::span<const float> plane, std::vector<float>& out);

/// Of a 96×96 plane: autocorrelation by radius (mean, lowest, highest over the angles).
void add_repetition(std::span<const float> plane, std::vector<float>& out);

}  // namespace weft
