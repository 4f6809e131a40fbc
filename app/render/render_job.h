#pragma once
// The only code path that renders a shot to files: the command line runs it in its own process, the
// editor in a child process, a farm in parts.

#include <cstdint>
#include <string>
#include <vector>

#include "app/cache/analysis_cache.h"
#include "app/exchange/input_files.h"
#include "app/render/form_report.h"
#include "app/render/light_report.h"
#include "app/shot/shot.h"
#include "engine/compute/backend_registry.h"
#include "engine/core/cancel.h"
#include "engine/core/progress.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

enum class ExistingFrames {
    kRefuse,  ///< Stop before rendering.
    kOverwrite,
    kSkip,   ///< Keep frames that are readable and have the plate's size; render the others.
    kResume  ///< Keep those of them that were rendered with the same settings from the same inputs.
};

/// A stage of a render, for machines that share it. Each stage reads the earlier stages' results
/// from the cache.
enum class JobStage {
    kAll,
    kMotion,   ///< The motion between neighbours, for the frames given.
    kAnalyse,  ///< The analysis of the whole shot.
    kPlanes,   ///< The texture planes.
    kFrames,   ///< The frames given, without a movie.
    kEncode    ///< The movie from frames that are there.
};
/// Parses a name: all, motion, analyse, planes, frames or encode. Errors: Usage.
[[nodiscard]] Expected<JobStage> parse_job_stage(const std::string& name);

/// Makes the libraries give the same bits on every x86-64 processor
/// (docs/decisions/0002-determinism.md). Call it once before computing the first image.
void make_libraries_deterministic();

/// Sets the number of threads of this process, OpenCV's included; 0 is one per processor. Also
/// calls make_libraries_deterministic().
void use_threads(int threads);

/// Keeps freed memory for the pictures that follow, in a process that makes many of them.
void keep_freed_memory();

/// A snapshot of everything that a render needs.
struct JobSpec {
    Project project;  ///< With absolute paths.
    std::string backend = "auto";
    int threads = 0;  ///< 0: one per processor.
    ExistingFrames existing = ExistingFrames::kRefuse;
    AnalysisCacheOptions cache;
    std::string texture_library;  ///< Library of textures "db:ID"; empty: the user's own.
    JobStage stage = JobStage::kAll;
    std::int64_t memory_bytes = 0;  ///< Memory limit; 0: none.
    /// Required settings_hash() of a job that other machines share; empty: any.
    std::string settings;
    /// Required InputHashes::text() of its frames `inputs_of`, which may be more than this run
    /// renders; empty: any.
    std::string inputs;
    std::vector<int> inputs_of;
    WriteLimits limits;
    std::string plane;    ///< Picture of the texture plane to write (plane_file.h); empty: none.
    std::string st_maps;  ///< Pattern of ST-maps to write (st_map_files.h); empty: none.
    /// Node trees to write (composite_files.h), with the layers that they need.
    std::vector<std::string> composites;
    /// Files that the caller writes afterwards; checked with the frames.
    std::string report, recipe;
};

struct FrameResult {
    int frame = 0;
    std::string path;
    double seconds = 0;
    bool skipped = false;
    std::int64_t above_one = 0, filled = 0;
    std::int64_t nonfinite = 0;  ///< Pixels of NaN or infinity in the plate.
    bool untouched = false;      ///< All mattes are empty on this frame.
};

struct StageSeconds {
    double open = 0, analyse = 0, synthesise = 0, render = 0, total = 0;
};

struct JobResult {
    std::vector<FrameResult> frames;
    StageSeconds seconds;
    double fps = 0;  ///< Frames/s over analysis and rendering.
    std::int64_t peak_rss_bytes = 0;
    std::string backend, backend_description;
    /// Better backends that are not available, with reasons.
    std::vector<std::string> passed_over;
    std::vector<std::string> warnings;
    /// Inputs that changed during the run: frames may be mixed.
    std::vector<std::string> changed_inputs;
    std::vector<std::optional<PlaneStats>> planes;
    std::vector<FormReport> forms;    ///< Of the regions whose form is known.
    std::vector<LightReport> lights;  ///< Of the regions whose light is estimated.
    ShotSpaces spaces;
    std::vector<ShotTexture> textures;
    std::string movie;
    Size size;
    /// Checked write rules of the report and the recipe.
    WriteRule report_rule, recipe_rule;
    std::shared_ptr<const Shot> shot;
};

/// Opens a backend: "auto", "cpu" or the name of a CUDA backend. Errors: as
/// BackendRegistry::choose().
[[nodiscard]] Expected<BackendChoice> choose_backend(const std::string& name);

/// Analyses, synthesizes, renders and writes. Frames are written atomically; frames finished before
/// an error or cancellation stay. The bytes do not depend on the number of threads. An input that
/// changes meanwhile is no error; see JobResult::changed_inputs. Errors: those of opening, the
/// backend, the disk, and cancellation. Sets the process's thread count.
[[nodiscard]] Expected<JobResult> run_job(const JobSpec& spec, const CancelToken& cancel,
                                          const ProgressFn& progress);

/// Does all checks of run_job() before its work: files, licences, regions, output format, existing
/// output. Creates only the output's folder. The result has no rendered frames. Errors: those of
/// run_job() before its first frame.
[[nodiscard]] Expected<JobResult> check_job(const JobSpec& spec);

/// Renders only the mattes: propagated (or read) and written to `pattern`, with each frame's
/// confidence.
struct MatteResult {
    int frame = 0;
    std::string path;
    float confidence = 1;
    bool painted = false;    ///< The frame is a keyframe, painted or frozen.
    bool suggested = false;  ///< Suggested keyframe: a matte here helps most.
};
/// Adds problems that are no errors to `warnings`. Errors: those of opening, of the disk, and of an
/// input that changed meanwhile.
[[nodiscard]] Expected<std::vector<MatteResult>> run_matte_job(const JobSpec& spec,
                                                               const std::string& pattern,
                                                               const CancelToken& cancel,
                                                               const ProgressFn& progress,
                                                               std::vector<std::string>& warnings);

}  // namespace weft
