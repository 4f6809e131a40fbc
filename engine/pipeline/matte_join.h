#pragma once
// Between two keyframes: what the walks from both have found becomes one matte.

#include "engine/pipeline/matte_stop.h"

namespace weft {

/// Learns what both sides look like on a keyframe, before anything is collected from it.
void learn_key(MatteStretch& job, const MatteStop& at, const Matte& painted);
/// The keyframe on which the walk back begins or, which it does not visit, the one before.
[[nodiscard]] Status collect_key(const PassContext& context, MatteStretch& job,
                                 const MatteStop& at);
/// A frame of the walk back: `backward` is what it has found, `front` what passes in front there,
/// of matte_size(). Both walks' estimates are kept until all frames are decided. Errors: the
/// store's.
[[nodiscard]] Status collect(AnalysisStore& store, MatteStretch& job, const MatteStop& at,
                             MatteEstimate backward, const Matte& front);
/// Merges what was collected, on all frames of the stretches. Errors: the source's, the store's,
/// cancellation.
[[nodiscard]] Status join_walks(const PassContext& context, AnalysisStore& store,
                                std::vector<MatteStretch>& jobs);

}  // namespace weft
