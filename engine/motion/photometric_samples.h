#pragma once
// What the direct registrations share: which pixels are compared, and how.

#include <optional>
#include <vector>

#include "engine/motion/photometric_register.h"

namespace weft {

struct RegistrationSamples {
    std::vector<Vec2> p;       ///< Pixel centres, frame coordinates, row by row.
    std::vector<float> value;  ///< RegistrationPicture::value there.
    [[nodiscard]] std::size_t size() const { return p.size(); }
};

/// A regular grid of the region's inner pixels, at most about `most` of them.
[[nodiscard]] RegistrationSamples registration_samples(const RegistrationPicture& picture,
                                                       int most);

/// The samples' places in the anchor.
[[nodiscard]] std::vector<Vec2> places_under(const LatticeField& anchor_from_cur,
                                             const RegistrationSamples& samples);

/// One sample whose place the anchor shows.
struct RegistrationResidual {
    Vec2 p;         ///< The sample's.
    float r;        ///< What the anchor shows less the sample's value.
    Vec2 gradient;  ///< Of the anchor there, per pixel.
};

/// All of them in the samples' order. The anchor is looked up by Catmull–Rom.
[[nodiscard]] std::vector<RegistrationResidual> residuals_at(const RegistrationPicture& anchor,
                                                             const RegistrationSamples& samples,
                                                             const std::vector<Vec2>& places);

/// The picture at any position by Catmull–Rom; empty outside its region.
[[nodiscard]] std::optional<float> look_up(const RegistrationPicture& picture, Vec2 p);

/// 1.4826 · median of the absolute residuals, at least what one level of noise gives.
[[nodiscard]] double robust_spread(const std::vector<RegistrationResidual>& residuals);

/// Weight of a residual of r robust deviations (Cauchy, 95% efficient at 2.385).
[[nodiscard]] inline double cauchy(double r) {
    return 1 / (1 + (r / 2.385) * (r / 2.385));
}

}  // namespace weft
