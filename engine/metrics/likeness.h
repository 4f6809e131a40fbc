#pragma once
// A result compared with the ideal: the same surface rendered with the new material.

#include <array>
#include <vector>

#include "engine/core/image.h"
#include "engine/metrics/drift.h"

namespace weft {

/// One frame. Differences are means of |expected − seen| over pixels and channels, 8-bit levels;
/// negative if there is no such pixel.
struct FrameLikeness {
    int frame = 0;
    ResidualMotion features;  ///< Displacement of the picture's features, inside the matte.
    double interior = -1;     ///< Where the matte is 250 and more.
    double soft_edge = -1;    ///< Where it is 5 to 249.
    double outside = -1;
    /// Change of the soft edge's error since the frame before: mean over soft pixels of |(expected
    /// − seen)(t) − (expected − seen)(t − 1)|. 0 for an edge that is wrong in the same way in every
    /// frame; large for one that boils.
    double soft_edge_change = -1;
};

/// The part of a frame that differs most, for visual inspection.
struct WorstCrop {
    int frame = 0;
    Recti box;
    double difference = 0;  ///< Mean over the box's pixels inside the matte, levels.
    ImageU8x3 expected, seen;
};

/// Compares two sequences over a matte, frame by frame in time order. Not thread-safe.
class SequenceLikeness {
  public:
    explicit SequenceLikeness(int most_crops = 10) : most_crops_(most_crops) {}

    /// Both display-encoded, white 1.0, H×W×3; `matte` H×W. All frames have one size.
    const FrameLikeness& add(int frame, ViewF3 expected, ViewF3 seen, ViewU8x1 matte);

    [[nodiscard]] const std::vector<FrameLikeness>& frames() const { return frames_; }
    /// At most one per frame, the worst first.
    [[nodiscard]] const std::vector<WorstCrop>& worst() const { return worst_; }
    /// Means over the frames that have the figure (`offset_px`: over all patches).
    struct Summary {
        double offset_px = 0, largest_offset_px = 0;  ///< Of features; the largest of a frame.
        double interior = 0, soft_edge = 0, outside = 0, soft_edge_change = 0;
    };
    [[nodiscard]] Summary summary() const;

  private:
    void keep_worst(int frame, ViewF3 expected, ViewF3 seen, ViewU8x1 matte);

    int most_crops_;
    std::vector<FrameLikeness> frames_;
    std::vector<WorstCrop> worst_;
    ImageF3 last_error_;
    Matte last_matte_;
};

/// The crops side by side: expected on top, seen below it, then four times their difference about
/// grey.
[[nodiscard]] ImageU8x3 strip_of(const std::vector<WorstCrop>& crops);

}  // namespace weft
