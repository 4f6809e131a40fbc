#pragma once
// The motion of a project's surfaces for other programs, without a render: ST-maps, vectors, corner
// pins, roto shapes, meshes.

#include <optional>
#include <string>
#include <vector>

#include "app/cache/analysis_cache.h"
#include "app/exchange/input_files.h"
#include "app/render/render_job.h"
#include "engine/media/image_files.h"

namespace weft {

/// How ST-maps are laid out in files; the numbers are the same (docs/FORMATS.md).
enum class StConvention {
    kNuke,    ///< One file: R, G, B, A and stabilize.R, .G, .B, .A, as a render writes them.
    kFusion,  ///< A file for each way, with the channels U and V besides.
    kBlender  ///< A file for each way.
};

/// What is written of each region.
struct MotionExports {
    bool st_maps = true, vectors = true, corner_pins = true, shapes = false, mesh = false;
};

struct MotionJobSpec {
    Project project;     ///< With absolute paths.
    std::string folder;  ///< To write into; created if it is missing.
    /// Names or ids; empty: all enabled ones.
    std::vector<std::string> regions;
    std::optional<int> reference;  ///< Empty: each region's own (first) reference frame.
    std::string frames;            ///< A frame list; empty: all that the project renders.
    MotionExports what;
    StConvention st = StConvention::kNuke;
    /// A set of files for each; not kFiles.
    std::vector<MotionConvention> vectors{MotionConvention::kNuke};
    /// kResume keeps frames of the same motion and settings; kSkip is not supported.
    ExistingFrames existing = ExistingFrames::kRefuse;
    AnalysisCacheOptions cache;
    int threads = 0;  ///< 0: one per processor.
    WriteLimits limits;
};

struct MotionJobResult {
    std::string manifest;  ///< The text of motion.json: "weft.motion/1" (docs/FORMATS.md).
    std::int64_t written = 0, kept = 0;  ///< Pictures.
    std::vector<std::string> notes, warnings;
};

/// Analyses what is missing of the shot's analysis, as a render of the project would, and writes
/// the motion of its regions. Another reference frame than the analysed one needs no other
/// analysis. Each file appears whole or not at all; "motion.json", written last, says "complete":
/// true when all of them are there. The bytes depend on neither threads nor folder. Sets the
/// process's thread count. Errors: those of opening the shot and analysing it; Usage (no region, no
/// such one, one that is not in locked mode, nothing of it visible on the reference frame, files
/// that exist already), MissingFrames (frames or a reference frame that the shot lacks), NoSpace;
/// an input that changed meanwhile; cancellation. Frames finished before an error stay.
[[nodiscard]] Expected<MotionJobResult> run_motion_job(const MotionJobSpec& spec,
                                                       const CancelToken& cancel,
                                                       const ProgressFn& progress);

}  // namespace weft
