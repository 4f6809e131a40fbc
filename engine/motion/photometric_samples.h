#pragma once
// What the direct registrations share: which pixels are compared, and how.

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/motion/interpolation_noise.h"
#include "engine/motion/photometric_register.h"

namespace weft {

struct RegistrationSamples {
    std::vector<Vec2> p;       ///< Pixel centres, frame coordinates, row by row.
    std::vector<float> value;  ///< RegistrationPicture::value there.
    double weight = 1;         ///< For how many each stands: more where they were thinned.
    [[nodiscard]] std::size_t size() const { return p.size(); }
};

/// The side of the two box filters that make the local mean, px, at a frame's width.
[[nodiscard]] int local_window(int width);

/// A regular grid of the region's inner pixels, at most about `most` of them; of these every
/// `thinned`th along either axis, if thousands are left.
[[nodiscard]] RegistrationSamples registration_samples(const RegistrationPicture& picture, int most,
                                                       int thinned = 1);

/// The samples' places in the anchor.
[[nodiscard]] std::vector<Vec2> places_under(const LatticeField& anchor_from_cur,
                                             const RegistrationSamples& samples);

/// One sample whose place the anchor shows.
struct RegistrationResidual {
    Vec2 p;         ///< The sample's.
    float r;        ///< What the anchor shows less the sample's value.
    Vec2 gradient;  ///< Of the anchor there, per pixel.
    Vec2 noise;     ///< InterpolationNoise::slope() there,
    float rough;    ///< its roughness(),
    float both;     ///< and the variance of either picture's noise together.
};

/// All of them in the samples' order. The anchor is looked up by Catmull–Rom.
[[nodiscard]] std::vector<RegistrationResidual> residuals_at(const RegistrationPicture& anchor,
                                                             const RegistrationSamples& samples,
                                                             const std::vector<Vec2>& places,
                                                             const InterpolationNoise& noise = {});

/// The noise of two pictures, from what their differences under a map have in common from pixel to
/// pixel. Pure; deterministic.
[[nodiscard]] InterpolationNoise noise_between(const RegistrationPicture& anchor,
                                               const RegistrationPicture& cur,
                                               const LatticeField& anchor_from_cur);

/// The picture at any position by Catmull–Rom; empty outside its region.
[[nodiscard]] std::optional<float> look_up(const RegistrationPicture& picture, Vec2 p);

/// 1.4826 · the median of absolute values; 0 of none.
[[nodiscard]] double robust_deviation(std::vector<float> sizes);

/// The robust_deviation() of the residuals, at least what one level of noise gives.
[[nodiscard]] double robust_spread(const std::vector<RegistrationResidual>& residuals);

/// What noise does to the normal equations of some residuals.
class NoiseInResiduals {
  public:
    void add(const RegistrationResidual& residual, double weight) {
        const double r = residual.r, x = residual.gradient.x, y = residual.gradient.y;
        weights_ += weight * static_cast<double>(residual.both);
        squares_ += weight * r * r;
        gradients_ += weight * (x * x + y * y);
        rough_ += weight * static_cast<double>(residual.rough);
    }
    void add(const NoiseInResiduals& other) {
        weights_ += other.weights_;
        squares_ += other.squares_;
        gradients_ += other.gradients_;
        rough_ += other.rough_;
    }
    /// Of either picture's noise, as it counts in weighted residuals: they differ by that of both.
    [[nodiscard]] double variance() const { return weights_ > 0 ? squares_ / weights_ : 0; }
    /// The share λ of the squared gradients that is not noise, where residuals spread by `spread`.
    /// Of the equations A d = b of all of them, A d = b / λ is what places d on the mean, with the
    /// precision λ² A: both sides of λ² A d = λ b.
    [[nodiscard]] double structure(double spread) const {
        constexpr double kLeast = 0.25;
        const double noise = 0.5 * spread * spread * rough_;
        return gradients_ > 0 ? std::max(kLeast, 1 - noise / gradients_) : 1;
    }

  private:
    double weights_ = 0, squares_ = 0, gradients_ = 0, rough_ = 0;
};

/// Weight of a residual of r robust deviations (Cauchy, 95% efficient at 2.385).
[[nodiscard]] inline double cauchy(double r) {
    return 1 / (1 + (r / 2.385) * (r / 2.385));
}

}  // namespace weft
