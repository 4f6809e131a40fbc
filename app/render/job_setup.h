#pragma once
// Prepares a render. All errors of the project and its files are found here, before any work.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/render/composite_files.h"
#include "app/render/output_plan.h"
#include "app/render/render_job.h"
#include "engine/media/frame_writer.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

struct JobSetup {
    std::shared_ptr<const Backend> backend;
    std::shared_ptr<const Shot> shot;
    ShotPlan plan;  ///< The shot's plan, with frames still to be rendered.
    SequencePattern pattern = SequencePattern::single("");
    /// Pattern of separate EXR files for the layers.
    std::optional<SequencePattern> layer_pattern;
    WriteOptions write;  ///< Of all frames; write_of() has what each adds.
    /// "weft:inputs" of each frame of the shot to render, kept or not.
    std::map<int, std::string> inputs;
    [[nodiscard]] WriteOptions write_of(int frame) const;
    std::optional<SequencePattern> st_map_pattern;  ///< Pattern of the ST-maps.
    WriteRule movie_rule, plane_rule;
    std::vector<WriteRule> composite_rules;  ///< Of each of composite_outputs().
    /// What node trees read.
    [[nodiscard]] CompositeSources composite_sources() const;
    std::size_t frames_at_once = 1;  ///< Frames rendered in parallel, limited by memory.
    /// Results known so far: frames (with skipped ones), spaces, textures, warnings.
    JobResult result;
};

/// Opens the shot, does all checks of run_job() and prepares the output folders. `leave_out`:
/// frames used only for measurement that cannot be read. Sets the process's thread count. `shot` is
/// set once it is open, even if a later step fails. Errors: those of check_job().
[[nodiscard]] Expected<JobSetup> set_up_job(const JobSpec& spec, const std::vector<int>& leave_out,
                                            std::shared_ptr<const Shot>& shot,
                                            OutputFolders folders = OutputFolders::kMake);

}  // namespace weft
