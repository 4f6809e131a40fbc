// weft look, collect, submit and task.
#include <filesystem>
#include <map>

#include "app/base/find_program.h"
#include "app/cli/commands.h"
#include "app/exchange/collect.h"
#include "app/exchange/kept_textures.h"
#include "app/exchange/look.h"
#include "app/farm/farm.h"
#include "app/project/codec/project_file.h"
#include "app/project/codec/update_project.h"
#include "engine/core/child_process.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

Status submit_to_slurm(const std::string& folder) {
    if (find_program("sbatch").empty())
        return fail(ErrorCode::kUsage, "sbatch is not available on this machine.",
                    "Run submit.sh on one that has it.");
    WEFT_TRY(child, start_process({"/bin/sh", (fs::path(folder) / "submit.sh").string()}, {}));
    const int code = wait_for_process(child);
    if (code == 0) return {};
    return fail(ErrorCode::kRenderFailed,
                "Slurm refused the job (exit code " + std::to_string(code) + ").",
                "Correct what sbatch says, then run submit.sh.");
}

Expected<std::vector<RootMap>> root_maps(const std::vector<std::string>& texts) {
    std::vector<RootMap> maps;
    for (const std::string& text : texts) {
        WEFT_TRY(map, parse_root_map(text));
        maps.push_back(map);
    }
    return maps;
}

}  // namespace

CommandResult look_save_command(const std::string& project, const std::string& look,
                                const std::string& region, const WriteFlags& write) {
    WEFT_TRY(loaded, load_project(project));
    const Project whole = resolve_paths(loaded, project_dir(project));
    WEFT_TRY(rule, write_rule(write, {project}, whole));
    WEFT_CHECK_OK(save_look(look, whole, region, rule));
    return Answer{{{"look", absolute_path(look)}}};
}

CommandResult look_apply_command(const std::string& look, const std::string& project,
                                 const std::string& region, const std::string& library) {
    const auto edit = [&](const Project& before) -> Expected<Project> {
        WEFT_TRY(changed, apply_look(look, before, project_dir(project), region));
        return keep_library_textures(changed, project, library);
    };
    WEFT_CHECK_OK(update_project(project, edit));
    return Answer{{{"project", absolute_path(project)}, {"look", absolute_path(look)}}};
}

CommandResult collect_command(const std::string& project, const std::string& folder,
                              const std::string& library, const RunOptions& run) {
    WEFT_TRY(loaded, load_project(project));
    const Project whole = with_mapped_roots(resolve_paths(loaded, project_dir(project)), run.maps);
    WEFT_TRY(collected,
             collect_project(whole, fs::path(project).filename().string(), folder, library,
                             {run.output_root, {project}}, cancel_on_signals(), {}));
    return Answer{{{"project", absolute_path(collected.project)},
                   {"files", collected.files},
                   {"bytes", collected.bytes}},
                  collected.project + " with " + std::to_string(collected.files) + " files, " +
                      std::to_string(collected.bytes >> 20) + " MiB\n"};
}

namespace {

Expected<FarmEngine> farm_engine(const SubmitOptions& options) {
    static const std::map<std::string, FarmEngine> kEngines{{"openjd", FarmEngine::kOpenJd},
                                                            {"slurm", FarmEngine::kSlurm},
                                                            {"deadline", FarmEngine::kDeadline},
                                                            {"opencue", FarmEngine::kOpenCue},
                                                            {"flamenco", FarmEngine::kFlamenco}};
    const auto engine = kEngines.find(options.engine);
    if (engine == kEngines.end()) {
        return fail(ErrorCode::kUsage,
                    "--to must be openjd, slurm, deadline, opencue or flamenco, not '" +
                        options.engine + "'.");
    }
    if (options.run && engine->second != FarmEngine::kSlurm) {
        return fail(ErrorCode::kUsage, "--run submits to Slurm only.",
                    "The files for " + options.engine + " are submitted with its own tools.");
    }
    if (options.write.overwrite + options.skip_existing + options.resume > 1) {
        return fail(ErrorCode::kUsage,
                    "--resume, --overwrite and --skip-existing contradict each other.",
                    "Give one.");
    }
    return engine->second;
}

// The project with paths as the farm workers see them.
Expected<Project> project_for_machines(const SubmitOptions& options) {
    WEFT_TRY(maps, root_maps(options.maps));
    WEFT_TRY(loaded, load_project(options.project));
    return with_mapped_roots(resolve_paths(loaded, project_dir(options.project)), maps);
}

// Fail now, rather than in a task, for whatever `weft render` would refuse.
Expected<std::vector<std::string>> write_job(const SubmitOptions& options, FarmEngine engine) {
    WEFT_TRY(project, project_for_machines(options));
    WEFT_CHECK_OK(check_document(project));
    const NamedByUser by_user{false, false, false, options.trust, options.write.root};
    const TrustList trusted = TrustList::of_user();
    WEFT_CHECK_OK(check_trust(project, options.project, by_user, trusted));
    JobSpec spec;
    spec.project = project;
    spec.backend = "cpu";
    spec.threads = options.threads;
    spec.texture_library = options.library;
    spec.limits = {options.write.root, {options.project}};
    spec.existing = options.write.overwrite ? ExistingFrames::kOverwrite
                    : options.skip_existing ? ExistingFrames::kSkip
                    : options.resume        ? ExistingFrames::kResume
                                            : ExistingFrames::kRefuse;
    WEFT_TRY(checked, check_job(spec));
    for (const std::string& note : checked.shot->notes)
        print(stderr, "weft: " + note + "\n");
    for (const std::string& warning : checked.warnings)
        print_warning(warning);
    FarmOptions farm;
    farm.engine = engine;
    farm.project_file = options.project;
    farm.project = std::move(project);
    farm.folder = options.folder;
    farm.cache = options.cache;
    farm.chunk = options.chunk;
    farm.threads = options.threads;
    farm.library = options.library;
    farm.existing = spec.existing;
    farm.roots = permitted_roots(farm.project, options.project, by_user, trusted);
    if (!options.write.root.empty()) farm.roots = {fs::absolute(options.write.root).string()};
    // Resuming a job replaces its files.
    WriteFlags write = options.write;
    write.overwrite =
        write.overwrite || (spec.existing != ExistingFrames::kRefuse &&
                            is_farm_job((fs::path(options.folder) / "job.json").string()));
    WEFT_TRY(rule, write_rule(write, {options.project}, farm.project));
    farm.rule = rule;
    return write_farm_job(farm, checked.shot);
}

}  // namespace

CommandResult submit_command(const SubmitOptions& options) {
    WEFT_TRY(engine, farm_engine(options));
    WEFT_TRY(written, write_job(options, engine));
    Answer answer;
    for (const std::string& path : written) {
        answer.json["files"].push_back(absolute_path(path));
        answer.text += path + "\n";
    }
    if (options.run) {
        const Status submitted = submit_to_slurm(options.folder);
        answer.json["submitted"] = submitted.has_value();
        if (!submitted) answer.error = submitted.error();
    }
    return answer;
}

CommandResult task_command(const std::string& job, const std::string& stage, int index,
                           const RunOptions& given) {
    // First, so that errors are also printed in the farm's format.
    static_cast<void>(progress_printer(given.progress));
    WEFT_TRY(task, read_farm_task(job, stage, index));
    RunOptions run = given;
    run.reads = {job};
    if (run.output_root.empty()) run.roots = task.output_roots;
    run.cache.folder = task.cache;
    run.texture_library = task.library;
    run.threads = task.threads;
    run.stage = task.stage;
    run.settings = task.settings;
    run.inputs = task.inputs;
    run.inputs_of = task.inputs_of;
    run.overwrite = task.existing == ExistingFrames::kOverwrite;
    run.skip_existing = task.existing == ExistingFrames::kSkip;
    run.resume = task.existing == ExistingFrames::kResume;
    run.backend = "cpu";  // for identical pixels on every machine
    return render_command(task.project, run);
}

}  // namespace weft
