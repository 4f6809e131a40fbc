#pragma once
// The frame stage of a render: renders frames, writes them and feeds the movie.

#include <cstdint>

#include "app/render/job_setup.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_scene.h"

namespace weft {

/// Returns true for an EXR file name; EXR files can hold layers.
[[nodiscard]] bool is_exr(const std::string& path);

/// Frames a second of the movie: the project's, otherwise the plate's, otherwise 24.
[[nodiscard]] double movie_fps(const Shot& shot);

/// Inputs of the frame stage; see render_frame().
struct FrameInputs {
    const JobSetup& setup;
    const ShotPlan& plan;
    const AnalysisStore& store;
    const std::vector<RegionScene>& scenes;
};

/// Renders and writes `frames` except skipped ones, and encodes all of them into `movie` unless it
/// is empty. Fills in the results of each frame. `done` counts finished frames, also on failure.
/// Errors: those of rendering and of the disk, and cancellation; frames finished earlier stay.
[[nodiscard]] Status render_frames(const FrameInputs& in, const std::string& movie,
                                   const CancelToken& cancel, const ProgressFn& progress,
                                   std::vector<FrameResult>& frames, std::int64_t& done);

}  // namespace weft
