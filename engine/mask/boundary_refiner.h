#pragma once
// Finds a boundary near where it is expected: local colour classifiers, a shape prior, a minimum
// cut in a narrow band, and the soft edge. Shared by the walker and by the merge of two walks.

#include <vector>

#include "engine/core/image.h"
#include "engine/mask/local_color.h"

namespace weft {

/// Lengths in pixels at the frame's size.
struct RefineScale {
    explicit RefineScale(Size frame);
    /// A pixel of 854×480.
    [[nodiscard]] float unit_px() const { return band_px / 10; }
    float band_px;       ///< How far the boundary may lie from the expected one.
    int window_half_px;  ///< Half a colour window's side.
    int window_step_px;  ///< Distance between windows along the boundary.
    int sample_stride;   ///< Colour samples are taken from every such pixel.
    float limit_px;      ///< Signed distances are clamped to this.
};

/// How well the evidence at the boundary agreed; each in 0–1, 1 is best.
struct BoundaryEvidence {
    float separability = 1;  ///< Of the colours inside and outside, along the expected boundary.
    /// How clearly the pixels beside the found boundary belong to their sides.
    float certainty = 1;
    float steadiness = 1;  ///< How little the found shape differs from the expected one.
};

struct RefinedBoundary {
    Matte matte;
    ImageF1 phi;  ///< Signed distance of the found boundary, pixels.
    BoundaryEvidence evidence;
};

/// Moves a boundary to where the antialiased edge of its matte says that it lies, by 0.75 px at
/// most. `phi`: its signed distance, pixels, of the size of `matte`.
void place_by_coverage(ImageF1& phi, ViewU8x1 matte);

/// Places windows along the zero line of `phi`, about `step_px` apart, in scan order.
[[nodiscard]] std::vector<ColorWindow> place_windows(ViewF1 phi, int step_px);

/// `frame`, `expected_phi`, `further_odds` (additional log odds for inside; may be empty) and
/// `wide_odds` (may be empty) are H×W. Where `wide_odds` contradict the expectation, pixels farther
/// from it than the band are decided too. `steadiness` (0–1): how much of a difference of less than
/// a pixel or two from the expected boundary counts as boil and is removed. Deterministic for any
/// number of threads.
[[nodiscard]] RefinedBoundary refine_boundary(ViewU8x3 frame, ViewF1 expected_phi,
                                              const LocalColorField& colors, ViewF1 further_odds,
                                              ViewF1 wide_odds, const RefineScale& scale,
                                              float steadiness);

/// Where the boundary of what lies in `bounds` may be found; empty if that is.
[[nodiscard]] Recti working_area(const Recti& bounds, const RefineScale& scale, Size frame);

}  // namespace weft
