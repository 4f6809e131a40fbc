#pragma once
// How well a texture lies on the true surface: its coordinates against a renderer's position pass.

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/image.h"
#include "engine/metrics/value_counts.h"

namespace weft {

/// Of the pixels that count; "not measured" below 200 of them is an empty optional.
struct MedianAnd90 {
    double median = 0, p90 = 0;
};

struct FormMeasures {
    struct Frame {
        int frame = 0;
        std::int64_t pixels = 0;  ///< That count.
        std::optional<MedianAnd90> stretch;
        /// The median of ½ ln(l1 l2), less that of the base frame, in per cent.
        std::optional<double> area_shift_percent;
        std::optional<double> flipped_share;
    };
    std::optional<int> base_frame;  ///< On which the texture has the right size.
    std::int64_t pixels = 0;
    std::optional<MedianAnd90> stretch, area_percent;
    std::optional<MedianAnd90> rim_stretch, rim_area_percent;  ///< From 4 to 12 px of the outline.
    std::optional<double> flipped_share, torn_share;
    std::vector<Frame> frames;
};

/// With J the texture's texels by pixel, P the surface's places by pixel, and l1 ≥ l2 the
/// eigenvalues of (PᵀP)⁻¹ JᵀJ: stretch is √(l1 / l2), 1 where the texture lies as on a sheet of
/// paper; area |½ ln(l1 l2) less its median over the base frame|, with that one median on all
/// frames. A pixel is flipped where det J ≤ 0, the texture being seen from behind, and torn where a
/// step of the coordinates departs by more than a texel from the step before it times the ratio of
/// the surface's steps. Pixels within 4 px of the outline, seen at a cosine below 0.15, or at a
/// fold are left out. docs/METHOD.md, "Measuring"; bench/evaluation/form.py is the same with the
/// camera and the normals of a scene. Not thread-safe.
class FormTruth {
  public:
    /// `plane`: texels of the picture that the coordinates 0–1 span; both positive. Only its
    /// proportions count. `focal_px`: of the camera, whose axis meets the picture's middle;
    /// nothing: the cosine is that of a camera far away, whose pixels are as high as they are wide.
    explicit FormTruth(Size plane, std::optional<double> focal_px = std::nullopt);

    /// What a frame showed, in pixels at least 4 px inside the matte.
    struct Seen {
        std::int64_t inside = 0;  ///< All.
        std::int64_t placed = 0;  ///< The surface's slope is known.
        std::int64_t laid = 0;    ///< Of these the texture's is not 0.
    };
    /// Adds a frame; all of one size. `positions`: H×W×3, one unit of length, not finite where
    /// unknown. `st`: H×W×2, the layer `st`: 0–1, origin at the bottom left, up to whole numbers.
    /// `matte`: the visible surface. `normals`: H×W×3 of unit length, for folds; empty: those of
    /// the places.
    Seen add(int frame, ViewF3 positions, ViewF2 st, ViewU8x1 matte, ViewF3 normals = {});

    /// Of all frames added. The base frame is `reference`, or if too little counts there the first
    /// that shows 60 % of the largest area; without one nothing is measured.
    [[nodiscard]] FormMeasures summary(int reference) const;

  private:
    struct Frame {
        FormMeasures::Frame measured;
        double area_px = 0, log_area = 0;  // covered pixels; median of ½ ln(l1 l2)
    };
    [[nodiscard]] const Frame* base_frame(int reference) const;

    Size plane_;
    std::optional<double> focal_px_;
    std::vector<Frame> frames_;
    ValueCounts stretch_, log_area_, rim_stretch_, rim_log_area_;  // natural logarithms
    std::int64_t flipped_ = 0, torn_ = 0;
};

}  // namespace weft
