#pragma once
// The shortest way to regions of which nothing is known on a frame yet.

#include <memory>
#include <utility>
#include <vector>

#include "engine/core/cancel.h"
#include "engine/pipeline/draft_source.h"
#include "engine/pipeline/provisional.h"

namespace weft {

/// Mattes and motion of some regions from the reference frame to one other, found in draft quality
/// on plates of a fraction of the size (draft_factor()); neither light nor grain.
struct DraftAnalysis {
    DraftAnalysis(ShotPlan of, int factor, Size plate)
        : plan(std::move(of)), store(factor, plate) {}

    ShotPlan plan;  ///< Of all regions; the others have nothing to analyse.
    DraftStore store;
    /// Refers to this.
    [[nodiscard]] EarlierAnalysis as_earlier() const;
};

/// Propagates the mattes of the `wanted` regions (one flag a region) from the nearest keyframes and
/// follows their surfaces from the reference frame with the placement to `frame`. Reads the frames
/// in between. What is found is of the plate's size. Errors: those of the source; cancellation,
/// which is checked between frames.
[[nodiscard]] Expected<std::unique_ptr<DraftAnalysis>> draft_analysis(
    const ShotSource& source, const ShotPlan& plan, int frame, const std::vector<bool>& wanted,
    const CancelToken& cancel = {});

}  // namespace weft
