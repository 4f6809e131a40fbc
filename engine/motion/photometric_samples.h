#pragma once
// What the direct registrations share: which pixels are compared, and how.

#include <optional>
#include <vector>

#include "engine/motion/photometric_register.h"

namespace weft {

struct RegistrationSample {
    Vec2 p;       ///< Pixel centre, frame coordinates.
    float value;  ///< RegistrationPicture::value there.
};

/// A regular grid of the region's inner pixels, at most about `most` of them.
[[nodiscard]] std::vector<RegistrationSample> registration_samples(
    const RegistrationPicture& picture, int most);

struct RegistrationLookup {
    float value;
    Vec2 gradient;  ///< Per pixel.
};

/// The picture at any position by Catmull–Rom, with its gradient; empty outside its region.
[[nodiscard]] std::optional<RegistrationLookup> look_up(const RegistrationPicture& picture, Vec2 p);

/// 1.4826 · median of absolute residuals, at least what one level of noise gives. Reorders.
[[nodiscard]] double robust_spread(std::vector<float>& sizes);

/// Weight of a residual of r robust deviations (Cauchy, 95% efficient at 2.385).
[[nodiscard]] inline double cauchy(double r) {
    return 1 / (1 + (r / 2.385) * (r / 2.385));
}

}  // namespace weft
