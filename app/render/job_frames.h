#pragma once
// The stage of a render that makes frames: renders them, writes them, and feeds the movie.

#include <cstdint>

#include "app/render/job_setup.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_scene.h"

namespace weft {

/// Whether a file of this name is an EXR, which can hold layers.
[[nodiscard]] bool is_exr(const std::string& path);

/// What the frames are rendered from; see render_frame().
struct FrameInputs {
    const JobSetup& setup;
    const ShotPlan& plan;
    const AnalysisStore& store;
    const std::vector<RegionScene>& scenes;
};

/// Renders and writes `frames` but those that are skipped, and encodes all of them into `movie`
/// where it is not empty. Fills in what is to be said of each frame. `done` counts those that are
/// finished, also when the stage fails. Errors: those of rendering and of the disk, and
/// cancellation; frames before one that fails stay.
[[nodiscard]] Status render_frames(const FrameInputs& in, const std::string& movie,
                                   const CancelToken& cancel, const ProgressFn& progress,
                                   std::vector<FrameResult>& frames, std::int64_t& done);

}  // namespace weft
