#pragma once
// Internal to follow_surfaces(): the regions on their way through the sweeps, and the sweeps.

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "engine/core/hash.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/paper_walker.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/surface_light.h"
#include "engine/pipeline/surface_pass.h"
#include "engine/pipeline/surface_track.h"
#include "engine/temporal/shutter.h"

namespace weft {

/// How a region's motion is known.
[[nodiscard]] inline SurfaceTrack::Motion motion_of(const RegionPlan& region) {
    if (!region.track.empty()) return SurfaceTrack::Motion::kKnown;
    return region.true_motion ? SurfaceTrack::Motion::kExact : SurfaceTrack::Motion::kEstimated;
}

/// One region on its way through the sweeps. Belongs to one thread.
struct SurfaceJob {
    int region = 0;
    int layer = 0;  // 0: the surface; a zone's zone_layer(): its surroundings
    const RegionPlan* plan = nullptr;
    FrameSpan span;
    std::vector<int> references;  // ascending
    int primary = 0;              // the reference that holds the placement
    bool coords = false, shading = false, paper = false, grain = false, shutter = false;

    std::optional<SurfaceTrack> track;
    // Whether the walk will likely ask for outlines: read while steps are gathered ahead of it.
    std::shared_ptr<std::atomic<bool>> asks_outline = std::make_shared<std::atomic<bool>>(true);
    bool bends = false;           // an earlier walk of the surface has refuted that it is a plane
    std::optional<Hash128> walk;  // names all that led to the track, if walks are kept
    int walked_to = 0, anchored_at = 0;  // frames: the last one, and where the walk is anchored
    std::set<int> held_frames;  // frames that repeat the drawing of the frame before in time
    std::optional<Shading> last_shading;
    SurfaceLight light;
    std::optional<PaperWalker> painter;
    ShutterMeter shutter_meter;
    std::optional<GrainMeter> meter;  // while grain is measured, with the frame before:
    ImageF3 last_display;
    Matte last_metered;

    [[nodiscard]] bool is_reference(int frame) const {
        return std::binary_search(references.begin(), references.end(), frame);
    }
    // Light is estimated from several frames at once, after the legs.
    [[nodiscard]] bool gathers_light() const { return shading && !plan->light_evidence.empty(); }
    // Between two references the first leg's result is not final; blend() completes it.
    [[nodiscard]] AnalysisKind coords_kind(int frame) const {
        const bool between =
            frame > references.front() && frame < references.back() && !is_reference(frame);
        return between ? AnalysisKind::kCoordsOneWay : AnalysisKind::kCoords;
    }
    [[nodiscard]] bool complete(const AnalysisStore& store) const {
        for (int f = span.first; f <= span.last; ++f) {
            if (coords && !store.has({region, f, AnalysisKind::kCoords, layer})) return false;
            if (shading && !store.has({region, f, AnalysisKind::kShading})) return false;
            if (paper && !store.has({region, f, AnalysisKind::kPaperTexture})) return false;
        }
        if (shutter && !store.has({region, primary, AnalysisKind::kShutter})) return false;
        return !grain || store.has({region, primary, AnalysisKind::kGrain});
    }
};

/// The regions that still need analysis.
[[nodiscard]] std::vector<SurfaceJob> surface_jobs(const ShotPlan& plan,
                                                   const AnalysisStore& store);

/// The three sweeps over all jobs; a sweep without work is empty.
struct SurfaceLegs {
    std::optional<SweepOptions> forward;   // from the primary references to the ends
    std::optional<SweepOptions> backward;  // from the last references to the begins
    std::optional<SweepOptions> again;     // from references before a primary up to it
    [[nodiscard]] int steps() const;       ///< Frames at which the sweeps stop, in all.
};

[[nodiscard]] SurfaceLegs surface_legs(const std::vector<SurfaceJob>& jobs);

}  // namespace weft
