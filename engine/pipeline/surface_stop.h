#pragma once
// Internal to follow_surfaces(): what can be said of a region on a frame ahead of its walk.

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/core/hash.h"
#include "engine/core/work_thread.h"
#include "engine/motion/held_frames.h"
#include "engine/pipeline/surface_job.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// The three sweeps; see SurfaceLegs.
enum class SurfaceLeg : std::uint8_t { kForward, kBackward, kAgain };

/// Whether a region is visited on a frame of a leg.
[[nodiscard]] bool visits(const SurfaceJob& job, SurfaceLeg leg, int frame);
/// Whether its walk begins there.
[[nodiscard]] bool begins(const SurfaceJob& job, SurfaceLeg leg, int frame);

/// A region on one frame of a leg.
struct SurfaceStop {
    Matte visible, extent;
    bool held = false;  ///< The drawing of the frame before is held.
    /// The step to the frame where motion is estimated, on the first frame its beginning, or comes
    /// from files. Nothing where estimated motion is held.
    std::optional<WalkStep> step;
    std::optional<Hash128> key;  ///< Names the step where motion is estimated, if walks are kept.
};

/// Prepares the stops of one leg in the order of its frames; one thread prepares while another one
/// takes. On many processors several frames are prepared at the same time.
class SurfaceStops {
  public:
    /// By job; nothing where a region is not visited.
    using Stops = std::vector<std::optional<SurfaceStop>>;

    SurfaceStops(const PassContext& context, const AnalysisStore& store,
                 const std::vector<SurfaceJob>& jobs, SurfaceLeg leg);

    /// How many frames should be prepared before they are taken.
    [[nodiscard]] int ahead() const { return std::max(1, static_cast<int>(workers_.size())); }
    /// Begins with all regions on the next frame. Errors: those of the source and the store, here
    /// or from take().
    [[nodiscard]] Status prepare(const SweepFrame& at);
    /// The oldest frame that was begun, when it is prepared.
    [[nodiscard]] Expected<Stops> take();

  private:
    struct Before {
        HeldFrames held;
        std::shared_ptr<const StepFrame> frame;  // the last one that was not held
        Hash128 key;                             // of the step to it, if walks are kept
        Hash128 views;                           // of the last one, if walks are kept
        Matte visible;                           // of the last one
        int number = 0;                          // of the last one
    };
    using Gather = std::function<Status(SurfaceStop&)>;  // what is still to be found out of a stop

    [[nodiscard]] Expected<Matte> extent_of(const SurfaceJob& job, int frame) const;
    [[nodiscard]] Expected<FlowField> true_motion(const SurfaceJob& job, int frame,
                                                  const Matte& visible_before) const;
    [[nodiscard]] Hash128 key_of(const Before& before, const Hash128& views,
                                 const SurfaceStop& stop, bool first) const;
    // `views`: hash of the frame's, if walks are kept.
    [[nodiscard]] Gather begin_step(const SurfaceJob& job, Before& before, const SweepFrame& at,
                                    const Hash128& views, SurfaceStop& stop) const;
    [[nodiscard]] Expected<SurfaceStop> begin_stop(const SurfaceJob& job, Before& before,
                                                   const SweepFrame& at, const Hash128& views,
                                                   Gather& gather) const;

    const PassContext& context_;
    const AnalysisStore& store_;
    const std::vector<SurfaceJob>& jobs_;
    const SurfaceLeg leg_;
    std::vector<Before> before_;
    std::mutex mutex_;
    std::deque<std::future<Expected<Stops>>> prepared_;
    std::size_t turn_ = 0;            // of the workers
    std::deque<WorkThread> workers_;  // use the members above until they are destroyed
};

}  // namespace weft
