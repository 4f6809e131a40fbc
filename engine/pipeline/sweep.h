#pragma once
// Visits a shot's frames in order, with the motion between neighbours.

#include <functional>
#include <memory>

#include "engine/core/cancel.h"
#include "engine/core/fields.h"
#include "engine/core/progress.h"
#include "engine/pipeline/frame_motion.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

class WalkMemory;

/// One stop of a sweep.
struct SweepFrame {
    int frame = 0;
    std::shared_ptr<const ImageF3> plate;
    /// What surfaces are followed by: the views of the frame `seen`, which is another one where
    /// this one shows nothing (ShownFrames).
    std::shared_ptr<const PlateViews> views;
    int seen = 0;
    [[nodiscard]] bool shows() const { return seen == frame; }
    bool cut = false;  ///< It is of another scene than what was seen on the frame before.
    /// Estimated motion to what was seen on the frame before (of the sweep) with its consistency,
    /// of follow_size(); null on the first frame and if the sweep uses no motion.
    std::shared_ptr<const FrameMotion> prev_from_cur;
};

/// From frame `first` to `last`, both inclusive, in either direction of time.
struct SweepOptions {
    int first = 0, last = 0;
    bool motion = true;
    int ahead = 1;  ///< Frames that are prepared before they are visited, at most.
    /// The motion of steps that this expects is not estimated before it is asked for; may be null.
    const WalkMemory* known = nullptr;
};

/// What all passes share.
struct PassContext {
    const ShotSource& source;
    const ShotPlan& plan;
    CancelToken cancel;
    std::function<void(int frame, double seconds)> step;  ///< Called after every frame.
    const Backend* backend = nullptr;                     ///< For growing textures, if any.
    std::shared_ptr<RecentMotions> motions = {};          ///< Of sweeps side by side; may be null.
};

using SweepVisitor = std::function<Status(const SweepFrame&)>;

/// Visits the frames in order. `prepare`, if any, gets every frame before `visit` does and must not
/// depend on what that does. With more than one thread, one frame is visited while the next ones
/// are prepared, and the motion of the one after them estimated; the results are the same without.
/// Errors: those of the source, of `prepare` and of `visit`, and cancellation.
[[nodiscard]] Status sweep(const PassContext& context, const SweepOptions& options,
                           const SweepVisitor& visit, const SweepVisitor& prepare = {});

/// prev_from_cur between two neighbours of a sweep, of follow_size(), estimated or taken from
/// ShotPlan::stages.
[[nodiscard]] FlowField motion_between(const ShotPlan& plan, int frame, const PlateViews& current,
                                       int previous, const PlateViews& previous_views);

/// Computes the motion between each of `frames` (ascending) and the one before it, in both
/// directions, and stores it in ShotPlan::stages for sweeps over `span`. Errors: those of the
/// source, cancellation.
[[nodiscard]] Status keep_motion(const ShotSource& source, const ShotPlan& plan,
                                 const std::vector<int>& frames, FrameSpan span,
                                 const CancelToken& cancel, const ProgressFn& progress);

/// The error of cancelled work.
[[nodiscard]] tl::unexpected<Error> cancelled(const CancelToken& cancel);

}  // namespace weft
