#pragma once
// The one way in which a shot becomes files: the command line runs it inline, the editor in a child
// process, a farm in pieces.

#include <cstdint>
#include <string>
#include <vector>

#include "app/exchange/input_files.h"
#include "app/render/analysis_cache.h"
#include "app/shot/shot.h"
#include "engine/compute/backend_registry.h"
#include "engine/core/cancel.h"
#include "engine/core/progress.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

enum class ExistingFrames {
    kRefuse,  ///< Stop before the first frame.
    kOverwrite,
    kSkip,   ///< Keep those that can be read and have the plate's size; render the others.
    kResume  ///< Keep those of them that were rendered with the same settings.
};

/// A part of a render, for machines that share it. Each uses what those before it left in the
/// cache.
enum class JobStage {
    kAll,
    kMotion,   ///< The motion between neighbours, for the frames given.
    kAnalyse,  ///< The analysis of the whole shot.
    kPlanes,   ///< The texture planes.
    kFrames,   ///< The frames given, without a movie.
    kEncode    ///< The movie from frames that are there.
};
/// By its name: all, motion, analyse, planes, frames or encode. Errors: Usage.
[[nodiscard]] Expected<JobStage> parse_job_stage(const std::string& name);

/// Lets the libraries give the same bits on every x86-64 processor
/// (docs/decisions/0002-determinism.md). Whoever computes pictures calls it once, before the first.
void make_libraries_deterministic();

/// Sets how many threads this process uses, OpenCV's included; 0 is one a processor. Keeps the
/// libraries steady too.
void use_threads(int threads);

/// A snapshot of everything that a render needs.
struct JobSpec {
    Project project;  ///< With absolute paths.
    std::string backend = "auto";
    int threads = 0;  ///< 0: one a processor.
    ExistingFrames existing = ExistingFrames::kRefuse;
    AnalysisCacheOptions cache;
    std::string texture_library;  ///< For textures "db:ID"; empty: the user's own.
    JobStage stage = JobStage::kAll;
    std::int64_t memory_bytes = 0;  ///< What the process should keep to; 0: no limit.
    /// What settings_hash() must give, for a part of a job that others render too; empty: anything.
    std::string settings;
    WriteLimits limits;
    std::string report, recipe;  ///< What the caller writes afterwards; checked with the frames.
};

struct FrameResult {
    int frame = 0;
    std::string path;
    double seconds = 0;
    bool skipped = false;
    std::int64_t above_one = 0, filled = 0;
    std::int64_t nonfinite = 0;  ///< Pixels of NaN or infinity in the whole plate.
    bool untouched = false;      ///< No matte reaches this frame.
};

struct StageSeconds {
    double open = 0, analyse = 0, synthesise = 0, render = 0, total = 0;
};

struct JobResult {
    std::vector<FrameResult> frames;
    StageSeconds seconds;
    double fps = 0;  ///< Frames a second over analysis and rendering.
    std::int64_t peak_rss_bytes = 0;
    std::string backend, backend_description;
    std::vector<std::string> passed_over;  ///< Better backends that could not be had.
    std::vector<std::string> warnings;
    /// Inputs that are not what they were when they were first read: frames may be mixed.
    std::vector<std::string> changed_inputs;
    std::vector<std::optional<PlaneStats>> planes;
    ShotSpaces spaces;
    std::vector<ShotTexture> textures;
    std::string movie;
    Size size;
    /// For the report and the recipe: as they were checked.
    WriteRule report_rule, recipe_rule;
    std::shared_ptr<const Shot> shot;
};

/// "auto", "cpu" or one of CUDA's names. Errors: as BackendRegistry::choose().
[[nodiscard]] Expected<BackendChoice> choose_backend(const std::string& name);

/// Analyses, synthesises, renders and writes. Frames appear whole or not at all; what was written
/// before an error or a cancellation stays. The bytes do not depend on the number of threads.
/// An input that was replaced meanwhile is no error here: see JobResult::changed_inputs. Errors:
/// those of opening, the backend, the disk, and cancellation. Sets the process's thread count.
[[nodiscard]] Expected<JobResult> run_job(const JobSpec& spec, const CancelToken& cancel,
                                          const ProgressFn& progress);

/// Everything that run_job() checks before it works: that the files are there, licences, regions,
/// the output's format, and what is there of the output. Makes the output's folder and no more.
/// The result has no frames rendered. Errors: those of run_job() before its first frame.
[[nodiscard]] Expected<JobResult> check_job(const JobSpec& spec);

/// Only the mattes: propagated (or read) and written to `pattern`, with the confidence of each
/// frame.
struct MatteResult {
    int frame = 0;
    std::string path;
    float confidence = 1;
    bool painted = false;    ///< A keyframe, painted or frozen.
    bool suggested = false;  ///< A matte painted here would help most.
};
/// What is odd but no error is added to `warnings`. Errors: those of opening, of the disk, and of
/// an input that changed meanwhile.
[[nodiscard]] Expected<std::vector<MatteResult>> run_matte_job(const JobSpec& spec,
                                                               const std::string& pattern,
                                                               const CancelToken& cancel,
                                                               const ProgressFn& progress,
                                                               std::vector<std::string>& warnings);

}  // namespace weft
