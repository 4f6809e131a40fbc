#pragma once
// A render before any work: everything that can be wrong with it is known by then.

#include <memory>
#include <optional>
#include <vector>

#include "app/render/output_plan.h"
#include "app/render/render_job.h"
#include "engine/media/frame_writer.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

struct JobSetup {
    std::shared_ptr<const Backend> backend;
    std::shared_ptr<const Shot> shot;
    ShotPlan plan;  ///< The shot's, with the frames that are still to be rendered.
    SequencePattern pattern = SequencePattern::single("");
    std::optional<SequencePattern> layer_pattern;  ///< Of EXR files of their own for the layers.
    WriteOptions write;
    WriteRule movie_rule;
    std::size_t frames_at_once = 1;  ///< That fit into memory.
    /// As far as it is known: the frames with those to be skipped, spaces, textures, warnings.
    JobResult result;
};

/// Opens the shot, checks everything that run_job() checks before it works, and prepares the
/// output's folders. `leave_out`: frames that are only measured, and cannot be read. Sets the
/// process's thread count. `shot` is set as soon as it is open, whatever goes wrong then. Errors:
/// those of check_job().
[[nodiscard]] Expected<JobSetup> set_up_job(const JobSpec& spec, const std::vector<int>& leave_out,
                                            std::shared_ptr<const Shot>& shot,
                                            OutputFolders folders = OutputFolders::kMake);

}  // namespace weft
