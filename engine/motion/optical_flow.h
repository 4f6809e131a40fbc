#pragma once
// Dense optical flow between two frames.

#include "engine/core/fields.h"
#include "engine/core/image.h"

namespace weft {

enum class FlowQuality { kDraft, kFinal };

/// Dense inverse search (Kroeger et al. 2016): for each pixel of `source` the displacement to
/// `target`, H×W×2 pixels, every pixel valid. 8-bit luma, both H×W. Pure; the same bits for any
/// number of threads.
[[nodiscard]] FlowField estimate_flow(ViewU8x1 source, ViewU8x1 target, FlowQuality quality);

struct FlowPair {
    FlowField b_from_a, a_from_b;
};
/// The motion in both directions, which share their work.
[[nodiscard]] FlowPair estimate_flows(ViewU8x1 a, ViewU8x1 b, FlowQuality quality);
/// The same of a part of frames of the size `frame`, searched as finely as those are.
[[nodiscard]] FlowPair estimate_flows(ViewU8x1 a, ViewU8x1 b, FlowQuality quality, Size frame);

/// Marks pixels as invalid whose way there and back misses by more than `tolerance_px` plus 5 % of
/// its length, or leaves the frame (Sundaram et al. 2010). Only `valid` changes.
void check_consistency(FlowField& target_from_source, FlowField& source_from_target,
                       float tolerance_px = 0.7f);
/// The same for the first field alone.
void check_consistency(FlowField& target_from_source, const ImageF2& source_from_target,
                       float tolerance_px = 0.7f);

/// Inverts a motion field by splatting. Invalid where nothing lands, or where contributions
/// disagree by more than a pixel because two surfaces meet.
[[nodiscard]] FlowField invert_flow(const FlowField& target_from_source);

}  // namespace weft
