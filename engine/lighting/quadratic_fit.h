#pragma once
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// A polynomial surface fitted to a plane where it is known. Edges do not bend it (iteratively
/// reweighted least squares, Holland & Welsch 1977, with Cauchy weights).
class PolynomialFit {
  public:
    /// All terms up to `degree`, 1 to 6.
    PolynomialFit(const ImageF1& plane, const ImageF1& weight, int degree);
    /// The surface at every pixel of the plane.
    [[nodiscard]] ImageF1 surface() const;

  private:
    int degree_;
    Size size_;
    std::vector<double> coefficients_;
    double centre_x_ = 0, centre_y_ = 0, scale_ = 1;
};

/// A fit with all terms up to degree 2.
class QuadraticFit : public PolynomialFit {
  public:
    QuadraticFit(const ImageF1& plane, const ImageF1& weight) : PolynomialFit(plane, weight, 2) {}
};

}  // namespace weft
