#pragma once
// Estimates of a render: time, memory and disk.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "app/project/project.h"
#include "engine/core/frame_range.h"
#include "engine/core/geometry.h"

namespace weft {

struct RenderEstimate {
    double seconds = 0;
    std::int64_t memory_bytes = 0, disk_bytes = 0;
};

struct EstimateInputs {
    Size size;                    ///< Size of the plate.
    std::size_t frames = 0;       ///< Frames to render.
    std::size_t analysed = 0;     ///< Frames to analyse for them; 0: the analysis is done.
    std::size_t regions = 0;      ///< Enabled regions.
    bool motion_given = false;    ///< All regions have motion files.
    bool mattes_painted = false;  ///< A region has painted mattes, which are propagated.
    Quality quality = Quality::kFinal;
    std::string_view extension;  ///< Extension of the output: "png", "exr", …
    bool layers = false;         ///< EXR layers are written too.
    unsigned threads = 2;
    double speed = 1;  ///< Speed relative to the measured machine (app/base/render_speed.h).
    /// What the analysis will take by a run of it that is on its way, s; 0: none is.
    double analysis_s = 0;
};

/// Number of frames that the analysis for frames `first` to `last` covers, including references,
/// corrections and painted mattes of the enabled regions, and the frames around a reference that
/// show its light and form. `all`: those of the plate.
[[nodiscard]] std::size_t analysed_frames(const Project& project, int first, int last,
                                          FrameRange all);
/// Sets what depends on the enabled regions.
void count_regions(const Project& project, EstimateInputs& in);

/// Time and disk within a factor of about two, memory within about a quarter; on the CPU.
/// Calibrated with clips timed on two cores (docs/BENCHMARKS.md). Pure.
[[nodiscard]] RenderEstimate estimate_render(const EstimateInputs& in);

}  // namespace weft
