#pragma once
// The plate's focus: how blurred its sharpest edges are, and the same blur for a sharper texture
// (method: "Composite").

#include <vector>

#include "engine/core/image.h"

namespace weft {

/// One place on an edge of a picture.
struct EdgeBlur {
    int x = 0, y = 0;
    float strength = 0;  ///< Gradient, of the display range per pixel.
    float blur_px = 0;   ///< Deviation of the Gaussian that blurs an ideal step this much.
};

/// The edges inside the matte whose gradient is at least `least_gradient`, at their middles, row by
/// row. The blur follows from the width, which is the step over its steepest slope. Linear light;
/// values above 1 count as 1.
[[nodiscard]] std::vector<EdgeBlur> edge_blurs(ViewF3 linear, ViewU8x1 matte,
                                               float least_gradient = 0.03f);

/// How sharp detail is at a place: the median blur (pixels) of the strongest two thirds of its
/// edges. 0 for fewer than 12 edges.
[[nodiscard]] float sharper_blur_px(std::vector<EdgeBlur> edges);

/// Deviation in pixels of the Gaussian that would blur ideal steps to the picture's strong edges
/// inside the matte (their median). 0 where there are too few edges to tell.
[[nodiscard]] float edge_blur_px(ViewF3 linear, ViewU8x1 matte);

/// Both at once: edge_blurs() and edge_blur_px() of one picture.
struct PictureFocus {
    std::vector<EdgeBlur> edges;
    float blur_px = 0;
};
[[nodiscard]] PictureFocus picture_focus(ViewF3 linear, ViewU8x1 matte, float least_gradient);

/// The blur that takes edges of `from_px` to `to_px`; 0 if they are sharper by at most a tenth.
[[nodiscard]] float blur_between(float from_px, float to_px);

/// The blur (deviation, pixels) that brings the texture's strong edges from `own_px`
/// (edge_blur_px()) to `plate_px`. Found by trying blur_between() and correcting by the result: a
/// lens blurs light, and under one blur the edge with more contrast looks sharper. 0 if the texture
/// is not sharper than the plate.
[[nodiscard]] float blur_to_match(ViewF3 texture, ViewU8x1 matte, float own_px, float plate_px);

}  // namespace weft
