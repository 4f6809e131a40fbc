#pragma once
// How sharp a texture is by itself, and how it takes a blur: measured once for a shot, so that the
// blur that a frame needs follows from the plate's alone.

#include <array>

#include "engine/core/image.h"

namespace weft {

struct TextureFocus {
    /// edge_blur_px() of the texture as the reference frame shows it; 0: it has too few edges.
    float own_px = 0;
    /// What a blur between its own and the plate's has to be multiplied with at kTried_px: under
    /// one blur the edge with more contrast looks sharper.
    std::array<float, 3> again{1, 1, 1};
    static constexpr std::array<float, 3> kTried_px{0.7f, 1.5f, 3.0f};

    /// Its own blur where it is shown `times` as large as on the reference frame.
    [[nodiscard]] float own_blur_px(float times) const;
    /// The blur (deviation, pixels) that brings its edges to the plate's; 0 if it is no sharper.
    /// Continuous in both. `own_px` must not be 0.
    [[nodiscard]] float needed_px(float times, float plate_px) const;
};

/// Measures it. `texture`: a part of it as the reference frame shows it, linear light.
[[nodiscard]] TextureFocus texture_focus(const ImageF3& texture);

}  // namespace weft
