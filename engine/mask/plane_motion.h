#pragma once
// The motion of what moves as one plane or as one stiff piece.

#include <array>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft {

struct MotionSample {
    int x, y;
    Vec2 d;            ///< Pixels.
    float weight = 1;  ///< Changed by the fit.
};

/// The motion of a plane in space (8 parameters, Longuet-Higgins & Prazdny 1980) over a frame, in
/// coordinates centred on the frame and divided by its width.
class PlaneMotion {
  public:
    static constexpr int kTerms = 8;

    /// Nothing moves.
    explicit PlaneMotion(Size frame);
    /// Fitted robustly to `samples` (iteratively reweighted least squares with Cauchy weights);
    /// nothing moves if there are fewer than four for each parameter. Deterministic.
    PlaneMotion(std::vector<MotionSample> samples, Size frame);

    /// Pixels, at pixel (x, y).
    [[nodiscard]] Vec2 at(double x, double y) const;

  private:
    using Terms = std::array<double, kTerms>;
    [[nodiscard]] std::array<Terms, 2> rows(double px, double py) const;
    void fit(const std::vector<MotionSample>& samples);

    Terms p_{};
    double centre_x_, centre_y_, unit_;
};

}  // namespace weft
