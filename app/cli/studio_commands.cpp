// weft look, collect, submit, task and doctor.
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/project/project_file.h"
#include "app/session/collect.h"
#include "app/session/farm.h"
#include "app/session/kept_textures.h"
#include "app/session/look.h"
#include "app/session/report.h"
#include "engine/media/atomic_file.h"
#include "gpu/cuda_backend.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Runs a script of ours without a shell in between; its exit code.
int run_script(const std::string& path) {
    char shell[] = "/bin/sh";
    std::string script = path;
    char* const argv[] = {shell, script.data(), nullptr};
    pid_t child = 0;
    if (posix_spawn(&child, shell, nullptr, nullptr, argv, environ) != 0) return 127;
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool is_on_path(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::string rest = path ? path : "";
    while (!rest.empty()) {
        const std::size_t colon = std::min(rest.find(':'), rest.size());
        if (access((fs::path(rest.substr(0, colon)) / program).c_str(), X_OK) == 0) return true;
        rest.erase(0, colon + 1);
    }
    return false;
}

struct Finding {
    std::string what, state, advice;
    bool good = true;
};

Finding folder_finding(const std::string& what, const std::string& path) {
    std::error_code error;
    fs::create_directories(path, error);
    const bool good = !path.empty() && access(path.c_str(), W_OK | X_OK) == 0;
    return {what, path.empty() ? "none" : path,
            good ? "" : "It cannot be written: set HOME, XDG_CACHE_HOME or --cache.", good};
}

}  // namespace

int look_save_command(const std::string& project, const std::string& look,
                      const std::string& region) {
    const auto loaded = load_project(project);
    if (!loaded) return report_error(loaded.error());
    const Status saved = save_look(look, resolve_paths(*loaded, project_dir(project)), region);
    return saved ? 0 : report_error(saved.error());
}

int look_apply_command(const std::string& look, const std::string& project,
                       const std::string& region, const std::string& library) {
    const auto loaded = load_project(project);
    if (!loaded) return report_error(loaded.error());
    const auto changed = apply_look(look, *loaded, project_dir(project), region);
    if (!changed) return report_error(changed.error());
    const auto kept = keep_library_textures(*changed, project, library);
    if (!kept) return report_error(kept.error());
    const Status saved = save_project(project, *kept);
    return saved ? 0 : report_error(saved.error());
}

int collect_command(const std::string& project, const std::string& folder,
                    const std::string& library, const RunOptions& run) {
    const auto loaded = load_project(project);
    if (!loaded) return report_error(loaded.error());
    const Project whole = with_mapped_roots(resolve_paths(*loaded, project_dir(project)), run.maps);
    const auto collected = collect_project(whole, fs::path(project).filename().string(), folder,
                                           library, cancel_on_signals(), {});
    if (!collected) return report_error(collected.error());
    if (run.json) {
        print(stdout, Json{{"project", collected->project},
                           {"files", collected->files},
                           {"bytes", collected->bytes}}
                              .dump(2) +
                          "\n");
    } else {
        print(stdout, collected->project + " with " + std::to_string(collected->files) +
                          " files, " + std::to_string(collected->bytes >> 20) + " MiB\n");
    }
    return 0;
}

int submit_command(const SubmitOptions& options) {
    static const std::map<std::string, FarmEngine> kEngines{{"openjd", FarmEngine::kOpenJd},
                                                            {"slurm", FarmEngine::kSlurm},
                                                            {"deadline", FarmEngine::kDeadline},
                                                            {"opencue", FarmEngine::kOpenCue},
                                                            {"flamenco", FarmEngine::kFlamenco}};
    const auto engine = kEngines.find(options.engine);
    if (engine == kEngines.end()) {
        return report_error({ErrorCode::kUsage,
                             "There is no farm '" + options.engine +
                                 "'. There are openjd, slurm, deadline, opencue and flamenco.",
                             {}});
    }
    if (options.run && engine->second != FarmEngine::kSlurm) {
        return report_error({ErrorCode::kUsage,
                             "--run submits to Slurm only. The files for " + options.engine +
                                 " are submitted with its own tools.",
                             {}});
    }
    std::vector<RootMap> maps;
    for (const std::string& text : options.maps) {
        const auto map = parse_root_map(text);
        if (!map) return report_error(map.error());
        maps.push_back(*map);
    }
    const auto loaded = load_project(options.project);
    if (!loaded) return report_error(loaded.error());
    OpenShotOptions open;
    open.texture_library = options.library;
    const auto shot = open_shot(
        with_mapped_roots(resolve_paths(*loaded, project_dir(options.project)), maps), open);
    if (!shot) return report_error(shot.error());
    if (const Status allowed = check_texture_licences(**shot); !allowed)
        return report_error(allowed.error());
    FarmOptions farm{engine->second, options.project, options.folder, options.cache,
                     options.chunk,  options.threads, options.maps,   options.library};
    const auto written = write_farm_job(farm, **shot);
    if (!written) return report_error(written.error());
    std::string text;
    for (const std::string& path : *written)
        text += path + "\n";
    print(stdout, options.json ? Json{{"files", *written}}.dump(2) + "\n" : text);
    if (!options.run) return 0;
    if (!is_on_path("sbatch")) {
        return report_error({ErrorCode::kUsage,
                             "There is no sbatch on this machine. Run submit.sh where there is.",
                             {}});
    }
    const int code = run_script((fs::path(options.folder) / "submit.sh").string());
    if (code == 0) return 0;
    return report_error({ErrorCode::kRenderFailed,
                         "Slurm refused the job (exit code " + std::to_string(code) + ").",
                         {}});
}

int task_command(const std::string& job, const std::string& stage, int index, ProgressStyle style) {
    // Before anything can go wrong, so that it is told in the farm's words.
    static_cast<void>(progress_printer(style, false));
    const auto task = read_farm_task(job, stage, index);
    if (!task) return report_error(task.error());
    const auto loaded = load_project(task->project);
    if (!loaded) return report_error(loaded.error());
    RunOptions run;
    for (const std::string& text : task->maps) {
        const auto map = parse_root_map(text);
        if (!map) return report_error(map.error());
        run.maps.push_back(*map);
    }
    Project project = resolve_paths(*loaded, project_dir(task->project));
    // The frames of the whole shot are the project's own, but in the stages that are cut into
    // parts.
    if (!task->frames.empty()) project.settings.frames = task->frames;
    run.cache.folder = task->cache;
    run.texture_library = task->library;
    run.threads = task->threads;
    run.stage = task->stage;
    run.resume = true;
    run.backend = "cpu";  // the same pixels on every machine
    run.progress = style;
    return render_command(project, run);
}

int doctor_command(const std::string& assets, bool json) {
    std::vector<Finding> findings;
    findings.push_back({"version", version_text(), "", true});
    for (const std::string name : {"cpu", "cuda"}) {
        const auto choice = choose_backend(name);
        findings.push_back(
            {"backend " + name, choice ? choice->backend->description() : choice.error().text(),
             choice || name == "cuda" ? "" : "The build is broken: install Weft again.",
             choice.has_value() || name == "cuda"});
    }
    findings.push_back(folder_finding("cache", cache_root({})));
    const char* ocio = std::getenv("OCIO");
    const bool ocio_good = !ocio || !*ocio || fs::exists(ocio);
    findings.push_back({"OpenColorIO", ocio && *ocio ? ocio : "built-in spaces (no $OCIO)",
                        ocio_good ? "" : "$OCIO names no file: correct or unset it.", ocio_good});
    const bool demo = fs::exists(fs::path(assets) / "demo" / "demo.weft");
    findings.push_back(
        {"demo shot", assets, demo ? "" : "Install Weft again, or give --assets.", demo});
    const bool display = std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY");
    findings.push_back(
        {"display", display ? "there" : "none: the editor cannot open; all else works", "", true});
    findings.push_back({"Slurm",
                        is_on_path("sbatch") ? "sbatch found" : "no sbatch: --run cannot submit",
                        "", true});
    Json list = Json::array();
    std::string text;
    bool good = true;
    for (const Finding& f : findings) {
        good = good && f.good;
        list.push_back(
            {{"what", f.what}, {"state", f.state}, {"good", f.good}, {"advice", f.advice}});
        text += std::string(f.good ? "ok   " : "FIX  ") + f.what + ": " + f.state +
                (f.advice.empty() ? "" : "\n     " + f.advice) + "\n";
    }
    print(stdout, json ? list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n" : text);
    return good ? 0 : exit_code(ErrorCode::kUnreadable);
}

}  // namespace weft
