#pragma once
// A frame before the shot has been analysed: what this frame alone says, for a first picture.

#include <memory>
#include <vector>

#include "engine/core/cancel.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// What render_frame() needs for a provisional picture of one frame.
struct ProvisionalFrame {
    /// The shot's plan. Regions that are not shown have an empty matte; what only other frames can
    /// tell (motion blur) is off.
    ShotPlan plan;
    std::vector<bool> shown;  ///< By region.
    /// The known analysis, and beneath it what this frame says alone. Refers to the known one,
    /// which must outlive it; refuses to store anything.
    std::unique_ptr<AnalysisStore> store;
    [[nodiscard]] bool shows_anything() const;
};

/// Another analysis of the same plate, which stands in for what is not known: of the settings
/// before an edit, or a draft. Does not own its parts.
struct EarlierAnalysis {
    const ShotPlan* plan = nullptr;
    const AnalysisStore* store = nullptr;
    /// By region of the present plan: its number in `plan`; −1: that has none.
    std::vector<int> region_of;
};

/// Prepares a provisional picture of `frame`. A region is shown if its texture's place on the frame
/// is known (it is the reference frame, has been analysed, or the mode needs no track), and its
/// mattes on the frame and on the reference are known (from files, painted there, or propagated
/// already). What is not known is taken from the first of `earlier` that has it; pins that were
/// moved since then are moved there. Other regions are left out rather than guessed. Light that has
/// not been measured is estimated from each frame alone; grain that has not been measured is left
/// out. Reads `frame` and the shown regions' reference frames, and never writes to `known`. Errors:
/// those of the source; cancellation.
[[nodiscard]] Expected<ProvisionalFrame> provisional_frame(
    const ShotSource& source, const ShotPlan& plan, const AnalysisStore& known, int frame,
    const std::vector<EarlierAnalysis>& earlier = {}, const CancelToken& cancel = {});

}  // namespace weft
