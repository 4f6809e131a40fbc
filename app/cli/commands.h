#pragma once
// The subcommands, independent of how their arguments are written.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/base/path_map.h"
#include "app/base/trust.h"
#include "app/cli/answer.h"
#include "app/cli/console.h"
#include "app/cli/write_flags.h"
#include "app/project/edit.h"
#include "app/project/validate.h"
#include "app/render/render_job.h"
#include "bench/shot/shot_bench.h"
#include "bench/study/study.h"
#include "engine/metrics/measuring_motion.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// Options of a run that do not depend on what it renders.
struct RunOptions {
    std::string backend = "auto";
    int threads = 0;
    bool overwrite = false, skip_existing = false, resume = false;
    bool version_up = false;
    std::vector<RootMap> maps;
    JobStage stage = JobStage::kAll;
    std::int64_t memory_bytes = 0;  ///< 0: no limit.
    std::string settings, inputs;   ///< As JobSpec has them.
    std::vector<int> inputs_of;
    std::string project_file;  ///< Project file that the outputs belong to; empty: none.
    NamedByUser by_user;
    std::string recipe;       ///< Path of the recipe file.
    std::string output_root;  ///< Folder that all writes must stay in; empty: no restriction.
    std::vector<std::string> roots;  ///< As WriteLimits has it.
    /// Files read besides the project's inputs: the project file, a job.
    std::vector<std::string> reads;
    bool dry_run = false;
    AnalysisCacheOptions cache;
    std::string texture_library;  ///< Library of textures "db:ID"; empty: the user's own.
    std::string report;           ///< Path of the JSON report.
    std::string plane, st_maps;   ///< As JobSpec has them.
    std::vector<std::string> composites;
    ProgressStyle progress = ProgressStyle::kPlain;
};

/// Prints the document's warnings. Errors: Usage when the document has an error.
[[nodiscard]] Status check_document(const Project& project);

/// `weft replace` and `weft render`: the project has its paths resolved.
CommandResult render_command(const Project& project, const RunOptions& run);

CommandResult look_save_command(const std::string& project, const std::string& look,
                                const std::string& region, const WriteFlags& write);
CommandResult look_apply_command(const std::string& look, const std::string& project,
                                 const std::string& region, const std::string& library);
CommandResult collect_command(const std::string& project, const std::string& folder,
                              const std::string& library, const RunOptions& run);
struct SubmitOptions {
    std::string project, engine, folder, cache, library;
    std::vector<std::string> maps;
    int chunk = 10, threads = 0;
    bool skip_existing = false, resume = false;
    bool run = false, trust = false;
    WriteFlags write;
};
/// `weft submit`, and `weft task`, which farm workers run.
CommandResult submit_command(const SubmitOptions& options);
CommandResult task_command(const std::string& job, const std::string& stage, int index,
                           const RunOptions& given);
CommandResult doctor_command(const std::string& assets);
/// `weft --version`: "weft 0.1.0 (commit abc1234), backends: cpu"
Answer version_answer();

/// `weft cryptomatte`: lists a frame's Cryptomatte objects, or finds the one that covers pixel `at`
/// ("X,Y").
CommandResult cryptomatte_command(const std::string& path, const std::string& at);

struct VerifyCommandOptions {
    std::string recipe, frames;
    bool quick = false;
};
/// `weft verify`
CommandResult verify_command(const VerifyCommandOptions& options, const RunOptions& run);

CommandResult matte_command(const Project& project, const std::string& output,
                            const RunOptions& run);

struct SynthOptions {
    std::vector<std::string> samples;
    std::string output, source_map, texture_space;
    std::string light;  ///< Image of the target illumination; empty: none.
    double light_weight = 0.1;
    std::string isa;  ///< Empty: the best available.
    std::string backend = "cpu";
    bool endless = false;  ///< A part of an unbounded plane, with its first texel at `at`.
    Vec2i at{0, 0};
    PlaneOptions plane;
    int threads = 0;
    WriteFlags write;
};
CommandResult synth_command(const SynthOptions& options);

struct BenchOptions {
    std::string sample;
    std::vector<int> sizes;
    int runs = 10;
    int threads = 1;
    std::string seams;      ///< Folder for images of the seams; empty: none.
    bool lighting = false;  ///< Only the cost of relighting relative to the paper's synthesis.
    /// Planes made by other programs, of which only the repetition is measured.
    std::vector<std::string> repetition_of;
    ShotBenchOptions shot;  ///< A plate: only the cost of replacing its texture by the sample.
    std::string isa, backend = "cpu";
    WriteFlags write;
};
CommandResult bench_command(const BenchOptions& options);

struct MeasureCommandOptions {
    Project project;  ///< Plate, matte, placement, motion; paths resolved.
    std::string result;
    std::string texture;  ///< Reference plane; empty: none.
    MeasuringEstimator estimator = MeasuringEstimator::kDeepFlow;
    std::string truth;  ///< Ground truth: the scene rendered with the new material; empty: none.
    double truth_blur_px = 0;
    std::string st;        ///< EXRs with the layer st; empty: none.
    std::string pictures;  ///< Folder for images of the light; empty: none.
    std::string cache;
    int threads = 0;
    WriteFlags write;
};
CommandResult measure_command(const MeasureCommandOptions& options);

/// `weft study`; `options` already holds threads, overwrite and the like.
CommandResult study_command(const StudyOptions& options, const RunOptions& run);

struct DiffOptions {
    std::string a, b;
    std::string frames;
    double tolerance = 0;  ///< Largest difference that counts as the same.
    /// Matte of the surface for measuring features, interior and soft edge separately. Empty: not
    /// measured.
    std::string matte;
    std::optional<int> matte_value;
    std::string matte_channel;
    std::string worst;  ///< Image of the ten worst crops; empty: none.
    WriteFlags write;
};
CommandResult diff_command(const DiffOptions& options);

CommandResult info_command(const std::string& path);
/// Converts an issue of the document to an error with its place as context.
[[nodiscard]] Error error_of(const Issue& issue);
CommandResult validate_command(const std::string& path, bool files);
CommandResult new_command(const std::string& path, const Project& project, const WriteFlags& write);
/// Changes a project file, as one step among its writers (update_project()): applies a file of
/// actions, adds a region, or changes the region of this name or id. Textures of the library
/// `library` (empty: the user's own) are copied beside the project.
CommandResult apply_command(const std::string& path, const std::string& actions,
                            const std::string& library, bool dry_run);
CommandResult region_add_command(const std::string& path, const Region& region,
                                 const std::string& library);
using RegionChange = std::function<Status(Region&)>;
CommandResult region_set_command(const std::string& path, const std::string& region,
                                 const RegionChange& change, const std::string& library);
CommandResult region_remove_command(const std::string& path, const std::string& region);
CommandResult region_correct_command(const std::string& path, const SetCorrection& edit);
CommandResult region_list_command(const std::string& path);

CommandResult demo_command(const std::string& assets, const std::string& given_output,
                           const RunOptions& run);

}  // namespace weft
