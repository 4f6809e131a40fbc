#pragma once
// The plate's focus: how blurred its sharpest edges are, and the same blur on a texture that is
// sharper (method: "Composite").

#include <vector>

#include "engine/core/image.h"

namespace weft {

/// One place on an edge of a picture.
struct EdgeBlur {
    int x = 0, y = 0;
    float strength = 0;  ///< Gradient, of the display range a pixel.
    float blur_px = 0;   ///< Deviation of the Gaussian that would blur an ideal step to it.
};

/// The edges inside the matte whose gradient is at least `least_gradient`, at their middles, by
/// their width, the step over its steepest slope; row by row. Linear light; values above 1 count as
/// 1.
[[nodiscard]] std::vector<EdgeBlur> edge_blurs(ViewF3 linear, ViewU8x1 matte,
                                               float least_gradient = 0.03f);

/// Of a place's edges the two thirds that are strongest, and of their blurs the median: how sharp
/// detail is there. 0 for fewer than a dozen edges.
[[nodiscard]] float sharper_blur_px(std::vector<EdgeBlur> edges);

/// Deviation in pixels of the Gaussian that would blur ideal steps to the picture's strong edges
/// inside the matte (their median). 0 where there are too few edges to tell.
[[nodiscard]] float edge_blur_px(ViewF3 linear, ViewU8x1 matte);

/// The blur that takes edges of `from_px` to `to_px`; 0 if they are sharper by at most a tenth.
[[nodiscard]] float blur_between(float from_px, float to_px);

/// The blur, in pixels, after which the texture's strong edges, of `own_px` now (edge_blur_px()),
/// are those of `plate_px`, found by trying blur_between() and correcting by what it gave: a lens
/// blurs light, and of two edges under one blur the one of more contrast looks the sharper. 0 where
/// they are no sharper.
[[nodiscard]] float blur_to_match(ViewF3 texture, ViewU8x1 matte, float own_px, float plate_px);

}  // namespace weft
