#pragma once
// Dense motion between two frames.

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

enum class FlowQuality { kDraft, kFinal };

/// DIS optical flow (Kroeger et al. 2016, OpenCV): for each pixel of `source` where it lies in
/// `target`, H×W×2 pixels, every pixel valid. 8-bit luma, both of one size. Deterministic.
[[nodiscard]] FlowField estimate_flow(ViewU8x1 source, ViewU8x1 target, FlowQuality quality);

/// Marks as invalid where going there and back misses by more than `tolerance_px` plus 5% of the
/// way, or leaves the frame (Sundaram et al. 2010). Both fields change only in `valid`.
void check_consistency(FlowField& target_from_source, FlowField& source_from_target,
                       float tolerance_px = 0.7f);
/// The same of the first field alone.
void check_consistency(FlowField& target_from_source, const ImageF2& source_from_target,
                       float tolerance_px = 0.7f);

/// Inverts a motion field by splatting; where nothing lands, or something nearer overwrote,
/// invalid.
[[nodiscard]] FlowField invert_flow(const FlowField& target_from_source);

}  // namespace weft
