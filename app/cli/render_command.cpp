#include <cmath>
#include <cstdio>
#include <filesystem>

#include "app/cli/commands.h"
#include "app/project/codec/project_file.h"
#include "app/project/validate.h"
#include "app/render/recipe.h"
#include "app/render/render_estimate.h"
#include "app/render/report.h"
#include "app/render/version_up.h"
#include "engine/core/frame_range.h"
#include "engine/core/parallel.h"
#include "engine/core/text.h"
#include "engine/media/atomic_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

JobSpec spec_of(const Project& project, const RunOptions& run) {
    JobSpec spec;
    spec.project = project;
    spec.backend = run.backend;
    spec.threads = run.threads;
    spec.existing = run.overwrite       ? ExistingFrames::kOverwrite
                    : run.skip_existing ? ExistingFrames::kSkip
                    : run.resume        ? ExistingFrames::kResume
                                        : ExistingFrames::kRefuse;
    spec.cache = run.cache;
    spec.texture_library = run.texture_library;
    spec.memory_bytes = run.memory_bytes;
    spec.stage = run.stage;
    spec.settings = run.settings;
    spec.inputs = run.inputs;
    spec.inputs_of = run.inputs_of;
    spec.limits = {run.output_root, run.reads, run.roots};
    spec.report = run.report;
    // A single stage writes no recipe, and what it makes only.
    const bool whole = run.stage == JobStage::kAll;
    if (whole) spec.recipe = run.recipe;
    if (whole) spec.composites = run.composites;
    if (whole || run.stage == JobStage::kPlanes) spec.plane = run.plane;
    if (whole || run.stage == JobStage::kFrames) spec.st_maps = run.st_maps;
    return spec;
}

RenderEstimate estimate_of(const Project& project, const Shot& shot, unsigned threads) {
    EstimateInputs in;
    in.size = shot.plate->size();
    in.frames = shot.plan.frames.size();
    in.analysed =
        analysed_frames(with_references(shot), shot.plan.frames.front(), shot.plan.frames.back(),
                        {shot.plate->frames().front(), shot.plate->frames().back() + 1});
    count_regions(project, in);
    in.quality = project.settings.quality;
    const std::string extension = fs::path(project.output.path).extension().string();
    in.extension = extension.empty() ? std::string_view() : std::string_view(extension).substr(1);
    in.layers = shot.plan.layers;
    in.threads = threads;
    return estimate_render(in);
}

// Lists what would be rendered, with an estimate of time, memory and disk.
CommandResult dry_run(const Project& project, const RunOptions& run) {
    OpenShotOptions open;
    open.texture_library = run.texture_library;
    WEFT_TRY(shot, open_shot(project, open));
    WEFT_CHECK_OK(check_texture_licences(*shot));
    const ShotPlan& plan = shot->plan;
    for (const std::string& note : shot->notes)
        print(stderr, "weft: " + note + "\n");
    for (const std::string& warning : shot->warnings)
        print_warning(warning);
    const unsigned threads = static_cast<unsigned>(run.threads > 0 ? run.threads : thread_count());
    const RenderEstimate estimate = estimate_of(project, *shot, threads);
    const Size size = shot->plate->size();
    const std::string frames = format_frame_list(plan.frames);
    Answer answer;
    answer.json = {{"dry_run", true},
                   {"plate",
                    {{"path", project.plate.path},
                     {"size", {size.width, size.height}},
                     {"space", shot->spaces.plate.name}}},
                   {"working_space", shot->spaces.working.name},
                   {"output",
                    {{"path", project.output.path},
                     {"movie", project.output.movie},
                     {"space", shot->spaces.out.name}}},
                   {"frames", frames},
                   {"frame_count", plan.frames.size()},
                   {"regions", Json::array()},
                   {"estimate",
                    {{"seconds", estimate.seconds},
                     {"threads", threads},
                     {"memory_bytes", estimate.memory_bytes},
                     {"disk_bytes", estimate.disk_bytes}}},
                   {"warnings", shot->warnings}};
    answer.text = "plate    " + project.plate.path + " (" + size_text(size) + ", " +
                  shot->spaces.plate.name + ")\n" + "working  " + shot->spaces.working.name + "\n" +
                  "output   " + project.output.path + " (" + shot->spaces.out.name + ")\n" +
                  "frames   " + frames + " (" + std::to_string(plan.frames.size()) + ")\n";
    for (std::size_t k = 0; k < plan.regions.size(); ++k) {
        const Region& region = *project.regions[shot->region_index[k]];
        const int reference = plan.regions[k].reference_frames.front();
        answer.json["regions"].push_back({{"name", region.name},
                                          {"texture", shot->textures[k].path},
                                          {"reference_frame", reference}});
        answer.text += "region   " + region.name + ": " + shot->textures[k].path +
                       ", reference frame " + std::to_string(reference) + "\n";
    }
    char line[160];
    std::snprintf(
        line, sizeof line,
        "takes    about %.0f s on %u threads of the CPU, %.1f GB of memory, %.1f MB of disk\n",
        estimate.seconds, threads, static_cast<double>(estimate.memory_bytes) / 1e9,
        static_cast<double>(estimate.disk_bytes) / 1e6);
    answer.text += line;
    return answer;
}

}  // namespace

Status check_document(const Project& project) {
    if (project.output.path.empty()) {
        return fail(ErrorCode::kUsage, "No output is set.",
                    "Give a pattern with -o, such as 'out/####.png'.");
    }
    for (const Issue& issue : validate(project)) {
        if (issue.severity == Severity::kError) return tl::unexpected(error_of(issue));
        print_warning(issue.text());
    }
    return {};
}

CommandResult render_command(const Project& given, const RunOptions& run) {
    Project project = with_mapped_roots(given, run.maps);
    if (run.version_up) {
        WEFT_TRY(versioned, version_up(project));
        project = std::move(versioned);
    }
    // Absolute, since reports and errors may be read from another folder.
    project = resolve_paths(project, absolute_path("."));
    if (run.overwrite + run.skip_existing + run.resume > 1) {
        return fail(ErrorCode::kUsage,
                    std::string(run.resume ? "--resume" : "--skip-existing") + " and " +
                        (run.overwrite ? "--overwrite" : "--skip-existing") +
                        " contradict each other.",
                    "Leave one out.");
    }
    NamedByUser by_user = run.by_user;
    by_user.output_root = run.output_root;
    const TrustList trusted = TrustList::of_user();
    WEFT_CHECK_OK(check_trust(project, run.project_file, by_user, trusted));
    if (run.dry_run) return dry_run(project, run);
    JobSpec spec = spec_of(project, run);
    const auto roots = permitted_roots(project, run.project_file, by_user, trusted);
    spec.limits.roots.insert(spec.limits.roots.end(), roots.begin(), roots.end());
    if (!roots.empty()) {
        std::vector<std::string> named{run.report, run.recipe, run.plane, run.st_maps};
        named.insert(named.end(), run.composites.begin(), run.composites.end());
        for (const std::string& path : named)
            if (!path.empty()) spec.limits.roots.push_back(fs::path(path).parent_path().string());
    }
    WEFT_TRY(result, run_job(spec, cancel_on_signals(), progress_printer(run.progress)));
    for (const std::string& note : result.shot->notes)
        print(stderr, "weft: " + note + "\n");
    for (const std::string& warning : result.warnings)
        print_warning(warning);
    const std::string report = report_json(spec, result);
    if (!run.report.empty())
        WEFT_CHECK_OK(write_file_atomically(run.report, report, result.report_rule));
    const Status unchanged = check_unchanged(result.changed_inputs);
    if (unchanged && !spec.recipe.empty()) {
        WEFT_TRY(recipe, recipe_json(*result.shot, result));
        WEFT_CHECK_OK(write_file_atomically(spec.recipe, recipe, result.recipe_rule));
    }
    Answer answer{Json::parse(report)};
    if (!unchanged) answer.error = unchanged.error();
    return answer;
}

CommandResult verify_command(const VerifyCommandOptions& given, const RunOptions& run) {
    const VerifyOptions options{given.recipe, given.frames, !given.quick, spec_of({}, run)};
    WEFT_TRY(result, verify_recipe(options, cancel_on_signals(), progress_printer(run.progress)));
    for (const std::string& warning : result.warnings)
        print_warning(warning);
    for (const std::string& difference : result.differences)
        print(stderr, "weft: " + difference + ".\n");
    const bool same = result.differences.empty();
    Answer answer;
    answer.json = {{"proved", same},
                   {"frames", result.frames},
                   {"inputs", result.inputs},
                   {"rerendered", !given.quick},
                   {"differences", result.differences}};
    answer.text = std::string(same ? "Proved: " : "Not proved: ") + std::to_string(result.frames) +
                  " frames from " + std::to_string(result.inputs) + " input files" +
                  (given.quick ? ", not rendered again.\n" : ", rendered again.\n");
    answer.exit = same ? 0 : exit_code(ErrorCode::kDiffers);
    return answer;
}

CommandResult matte_command(const Project& project, const std::string& output,
                            const RunOptions& run) {
    std::vector<std::string> warnings;
    const auto mattes = run_matte_job(spec_of(project, run), output, cancel_on_signals(),
                                      progress_printer(run.progress), warnings);
    for (const std::string& warning : warnings)
        print_warning(warning);
    if (!mattes) return tl::unexpected(mattes.error());
    Answer answer;
    answer.json = {{"output", absolute_path(output)},
                   {"mattes", Json::array()},
                   {"suggested_keyframes", Json::array()}};
    for (const MatteResult& m : *mattes) {
        const double confidence = static_cast<double>(m.confidence);
        answer.json["mattes"].push_back(
            {{"frame", m.frame}, {"confidence", std::round(1e4 * confidence) / 1e4}});
        if (m.suggested) answer.json["suggested_keyframes"].push_back(m.frame);
        char line[64];
        std::snprintf(line, sizeof line, "matte %d confidence %.2f%s\n", m.frame, confidence,
                      m.suggested ? "  put a keyframe here" : "");
        answer.text += line;
    }
    return answer;
}

}  // namespace weft
