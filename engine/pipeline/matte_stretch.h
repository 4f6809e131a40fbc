#pragma once
// How the mattes of a painted layer are divided into stretches that are propagated by themselves.

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/mask/joint_sides.h"
#include "engine/mask/matte_propagation.h"
#include "engine/mask/matte_reach.h"
#include "engine/motion/scene_watch.h"
#include "engine/pipeline/pending_mattes.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/region_plan.h"

namespace weft {

/// One stretch of a painted matte, a region's, a holdout's or a zone's: from a keyframe to the next
/// one, or beyond the first or last one. Nothing outside of a stretch changes its mattes.
struct MatteStretch {
    int region = 0, layer = 0;   ///< As in AnalysisKey.
    std::vector<int> keys;       ///< One or two.
    std::vector<int> confirmed;  ///< Frames between or beyond them that are confirmed in parts.
    MatteReach reach;
    FrameSpan own;  ///< The frames whose mattes it makes; a keyframe goes with the next.
    MatteOptions options;
    std::optional<MatteWalker> walker = {};  ///< Of the walk that goes on.
    SceneWatch scene = {};                   ///< Of the same walk.
    PendingMattes pending = {};              ///< Of it, too.
    JointSides joint = {};                   ///< Of both walks.

    static constexpr FrameSpan kNone{0, -1};

    [[nodiscard]] bool is_key(int frame) const {
        return std::binary_search(keys.begin(), keys.end(), frame);
    }
    [[nodiscard]] bool is_confirmed(int frame) const {
        return std::binary_search(confirmed.begin(), confirmed.end(), frame);
    }
    /// The keyframe in front of its frames, and the one behind them.
    [[nodiscard]] std::optional<int> key_before() const;
    [[nodiscard]] std::optional<int> key_after() const;
    /// Where two walks meet there are two estimates to merge.
    [[nodiscard]] bool merged(int frame) const;
    /// The frames for which that holds; empty: none.
    [[nodiscard]] FrameSpan merging() const;
    /// The frames of the walk back, and the keyframe at which it ends where it meets the other.
    [[nodiscard]] FrameSpan collecting() const;
    /// A holdout, which is in front of the region's other mattes.
    [[nodiscard]] bool in_front() const { return layer > 0; }
    /// All frames that it needs: its own, and its keyframes.
    [[nodiscard]] FrameSpan needed() const {
        return {std::min(own.first, keys.front()), std::max(own.last, keys.back())};
    }
    /// The frames that the walk visits in each direction; empty: none. It begins at a keyframe, or
    /// where there is none on that side with the farthest frame that is confirmed in parts.
    [[nodiscard]] FrameSpan forward() const;
    [[nodiscard]] FrameSpan backward() const;
};

[[nodiscard]] inline bool holds(FrameSpan span, int frame) {
    return frame >= span.first && frame <= span.last;
}
[[nodiscard]] inline int length(FrameSpan span) {
    return span.last - span.first + 1;
}

/// The frames that `of` any of the stretches visit, from the first to the last; empty: none.
[[nodiscard]] FrameSpan visited(const std::vector<MatteStretch>& jobs,
                                FrameSpan (MatteStretch::*of)() const);

/// The stretches of one painted matte over the frames of `span`.
[[nodiscard]] std::vector<MatteStretch> stretches(int region, int layer,
                                                  const PaintedMatte& painted, FrameSpan span);

}  // namespace weft
