#pragma once
// Internal to follow_surfaces(): what can be said of a region on a frame ahead of its walk.

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/pipeline/surface_job.h"
#include "engine/pipeline/sweep.h"
#include "engine/temporal/held_frames.h"

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
    /// Where motion was estimated, if the frame is neither held nor the first.
    std::optional<WalkStep> step;
};

/// Prepares the stops of one leg in the order of its frames; one thread prepares while another one
/// takes.
class SurfaceStops {
  public:
    SurfaceStops(const PassContext& context, const AnalysisStore& store,
                 const std::vector<SurfaceJob>& jobs, SurfaceLeg leg);

    /// Prepares all regions on the next frame. Errors: those of the source and the store.
    [[nodiscard]] Status prepare(const SweepFrame& at);
    /// The oldest prepared frame, by job; nothing where a region is not visited.
    [[nodiscard]] std::vector<std::optional<SurfaceStop>> take();

  private:
    struct Before {
        HeldFrames held;
        std::shared_ptr<const StepFrame> frame;  // the last one that was not held
    };
    [[nodiscard]] Expected<Matte> extent_of(const SurfaceJob& job, int frame) const;
    [[nodiscard]] Expected<SurfaceStop> stop_at(const SurfaceJob& job, Before& before,
                                                const SweepFrame& at) const;

    const PassContext& context_;
    const AnalysisStore& store_;
    const std::vector<SurfaceJob>& jobs_;
    const SurfaceLeg leg_;
    std::vector<Before> before_;
    std::mutex mutex_;
    std::deque<std::vector<std::optional<SurfaceStop>>> prepared_;
};

/// Calls one(k) for each region, side by side where that fills the processors better than what runs
/// in parallel inside of each.
void for_each_job(std::size_t jobs, const std::function<void(std::size_t)>& one);

}  // namespace weft
