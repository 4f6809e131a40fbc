#pragma once
// Mattes that a walk has found and may still complete.

#include <deque>
#include <utility>
#include <vector>

#include "engine/mask/matte_propagation.h"
#include "engine/pipeline/analysis_store.h"

namespace weft {

/// A matte to be stored.
struct PendingMatte {
    int frame = 0;
    AnalysisKind kind = AnalysisKind::kMatte;
    MatteEstimate estimate;
    bool open = true;  ///< Painted or confirmed ones stay as they are.
};

/// The last few frames of one walk. Not thread-safe.
class PendingMattes {
  public:
    void add(PendingMatte matte) { mattes_.push_back(std::move(matte)); }
    /// What the step to `frame` has found of the frames before (MatteWalker::take_late()); `step`:
    /// 1 or −1, the walk's direction of time.
    void complete(int frame, int step, const std::vector<Matte>& late);
    /// Those that no later step completes, in the order of the walk. `last`: there is none.
    [[nodiscard]] std::vector<PendingMatte> take(int frame, bool last);

  private:
    std::deque<PendingMatte> mattes_;
};

}  // namespace weft
