#pragma once
#include <array>

#include "engine/core/image.h"

namespace weft {

/// The quadratic surface nearest to a plane where it is known, not bent by edges (three rounds of
/// iteratively reweighted least squares, Holland & Welsch 1977, with Cauchy weights).
class QuadraticFit {
  public:
    QuadraticFit(const ImageF1& plane, const ImageF1& weight);
    [[nodiscard]] float at(int x, int y) const;

  private:
    static constexpr int kTerms = 6;
    std::array<double, kTerms> coefficients_{};
    double centre_x_ = 0, centre_y_ = 0, scale_ = 1;
};

}  // namespace weft
