#pragma once
// The subcommands, free of how their arguments were written.

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
#include "bench/study/study.h"
#include "engine/metrics/measuring_motion.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// How a job is run, whatever it renders.
struct RunOptions {
    std::string backend = "auto";
    int threads = 0;
    bool overwrite = false, skip_existing = false, resume = false;
    bool version_up = false;
    std::vector<RootMap> maps;
    JobStage stage = JobStage::kAll;
    std::int64_t memory_bytes = 0;  ///< 0: no limit.
    std::string settings;           ///< As JobSpec has it.
    std::string project_file;       ///< Whose outputs are the project's own; empty: of nobody's.
    NamedByUser by_user;
    std::string recipe;              ///< Path of the recipe file.
    std::string output_root;         ///< Nothing is written elsewhere; empty: anywhere.
    std::vector<std::string> roots;  ///< As WriteLimits has it.
    std::vector<std::string> reads;  ///< Read besides the project's inputs: its file, a job.
    bool dry_run = false;
    AnalysisCacheOptions cache;
    std::string texture_library;  ///< For textures "db:ID"; empty: the user's own.
    std::string report;           ///< Path of the JSON report.
    ProgressStyle progress = ProgressStyle::kPlain;
};

/// Prints the document's warnings. Errors: Usage, what is wrong with it.
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
/// `weft submit`, and `weft task`, which the farm's machines run.
CommandResult submit_command(const SubmitOptions& options);
CommandResult task_command(const std::string& job, const std::string& stage, int index,
                           const RunOptions& given);
CommandResult doctor_command(const std::string& assets);
/// Returns true if $PATH has an executable of this name.
[[nodiscard]] bool is_on_path(const std::string& program);
/// `weft --version`: "weft 0.1.0 (commit abc1234), backends: cpu"
Answer version_answer();

/// `weft cryptomatte`: what a frame's Cryptomatte holds, or what covers pixel `at` ("X,Y").
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
    std::string light;  ///< Picture of a wanted illumination; empty: none.
    double light_weight = 0.1;
    std::string isa;  ///< Empty: the best there is.
    std::string backend = "cpu";
    bool endless = false;  ///< A part of a plane without end, whose first texel is `at`.
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
    std::string seams;      ///< Folder for pictures of the seams; empty: none.
    bool lighting = false;  ///< Only what light costs beside the paper's synthesis.
    /// Planes of other programs: only their repetition is measured.
    std::vector<std::string> repetition_of;
    std::string isa, backend = "cpu";
    WriteFlags write;
};
CommandResult bench_command(const BenchOptions& options);

struct MeasureCommandOptions {
    Project project;  ///< Plate, matte, placement, motion; paths resolved.
    std::string result;
    std::string texture;  ///< Plane to compare with; empty: none.
    std::string motion_estimator = "deepflow";
    std::string truth;  ///< The scene rendered with the new material; empty: none.
    double truth_blur_px = 0;
    std::string pictures;  ///< Folder for pictures of the light; empty: none.
    std::string cache;
    int threads = 0;
    WriteFlags write;
};
CommandResult measure_command(const MeasureCommandOptions& options);

/// `weft study`; threads, overwrite and the like are in `options` already.
CommandResult study_command(const StudyOptions& options, const RunOptions& run);

struct DiffOptions {
    std::string a, b;
    std::string frames;
    double tolerance = 0;  ///< Largest difference that counts as the same.
    /// Where `b` should look like `a`: features, interior, soft edge. Empty: no such comparison.
    std::string matte;
    std::optional<int> matte_value;
    std::string matte_channel;
    std::string worst;  ///< Picture of the ten worst crops to write, or empty.
    WriteFlags write;
};
CommandResult diff_command(const DiffOptions& options);

CommandResult info_command(const std::string& path);
/// A fault of the document as an error whose context is its place.
[[nodiscard]] Error error_of(const Issue& issue);
CommandResult validate_command(const std::string& path, bool files);
CommandResult new_command(const std::string& path, const Project& project, const WriteFlags& write);
/// A project file changed by a file of actions, by a new region, by another region instead of the
/// one at `index`. Textures of the library `library` (empty: the user's own) are kept beside it.
CommandResult apply_command(const std::string& path, const std::string& actions,
                            const std::string& library, bool dry_run);
CommandResult region_add_command(const std::string& path, Region region,
                                 const std::string& library);
CommandResult region_set_command(const std::string& path, const Project& project, std::size_t index,
                                 const Region& changed, const std::string& library);
CommandResult region_remove_command(const std::string& path, const std::string& region);
CommandResult region_correct_command(const std::string& path, const SetCorrection& edit);
CommandResult region_list_command(const std::string& path);

CommandResult demo_command(const std::string& assets, const std::string& given_output,
                           const RunOptions& run);

}  // namespace weft
