#pragma once
// The plate's focus: how blurred its sharpest edges are, and the same blur for a sharper texture
// (method: "Composite").

#include <vector>

#include "engine/core/image.h"

namespace weft {

/// The blur of the sharpest edge that pixels allow, along the grid or diagonal to it, and the most
/// blur that is told from none.
inline constexpr float kSharpestEdge_px = 0.45f, kSoftestEdge_px = 6.0f;

/// One place on an edge of a picture.
struct EdgeBlur {
    int x = 0, y = 0;
    float strength = 0;  ///< Gradient, of the display range per pixel.
    float blur_px = 0;   ///< Deviation of the Gaussian that blurs an ideal step this much.
    Vec2i dark, bright;  ///< Where it ends, at most 12 steps away.
};

/// The edges inside the matte whose gradient is at least `least_gradient`, at their middles, row by
/// row; of a picture of more than 270 rows, on every second, third, … row. The blur follows from
/// the width, which is the step over its steepest slope. Linear light; values above 1 count as 1.
[[nodiscard]] std::vector<EdgeBlur> edge_blurs(ViewF3 linear, ViewU8x1 matte,
                                               float least_gradient = 0.03f);

/// How sharp detail is at a place: the blur (pixels) that a quarter of its edges stay below, of the
/// strongest two thirds. 0 for fewer than 12 edges.
[[nodiscard]] float sharper_blur_px(std::vector<EdgeBlur> edges);

/// The edges of a picture, and which of them are strong for it.
struct PictureEdges {
    std::vector<EdgeBlur> edges;  ///< As edge_blurs(), and the strong ones.
    float strong = 0;             ///< Strength from which they count as strong; 0: cannot be told.
};
[[nodiscard]] PictureEdges picture_edges(ViewF3 linear, ViewU8x1 matte, float least_gradient);

/// Deviation in pixels of the Gaussian that would blur ideal steps to the sharpest tenth of the
/// strong edges. 0 where there are too few edges to tell.
[[nodiscard]] float strong_blur_px(const PictureEdges& picture);
/// How far strong_blur_px() can be taken for the lens's, 0–1: 0 with fewer than 60 strong edges, or
/// where their blurs differ as those of penumbras and soft paint do; all of it from 180 edges of
/// which half stay below 1.8 times the blur of the sharpest tenth.
[[nodiscard]] float blur_confidence(const PictureEdges& picture);
/// Deviation of strong_blur_px(), from the blurs of the edges around that quantile; 0 where there
/// are too few edges to tell.
[[nodiscard]] float strong_blur_error_px(const PictureEdges& picture);
/// strong_blur_px() of a picture inside the matte.
[[nodiscard]] float edge_blur_px(ViewF3 linear, ViewU8x1 matte);

/// The blur that takes edges of `from_px` to `to_px`; 0 if they are sharper by at most a tenth, all
/// of it from four tenths.
[[nodiscard]] float blur_between(float from_px, float to_px);

/// The blur (deviation, pixels) that brings the texture's strong edges from `own_px`
/// (edge_blur_px()) to `plate_px`. Found by trying blur_between() and correcting by the result: a
/// lens blurs light, and under one blur the edge with more contrast looks sharper. 0 if the texture
/// is not sharper than the plate.
[[nodiscard]] float blur_to_match(ViewF3 texture, ViewU8x1 matte, float own_px, float plate_px);

}  // namespace weft
