// Flags shared by commands that render or analyse.

#include <filesystem>

#include "app/cli/command_line.h"
#include "app/cli/commands.h"
#include "app/cli/help/usage.h"
#include "app/cli/option_values.h"
#include "app/render/memory_plan.h"
#include "engine/media/decode_limit.h"

namespace weft {
namespace {

void add_library_option(CLI::App& command, std::string& library) {
    command
        .add_option("--db", library,
                    "Library of the textures 'db:ID'; default: the user's own (weft texture)")
        ->type_name("FILE");
}

void add_memory_flag(CLI::App& command, RunOptions& run) {
    command
        .add_option_function<std::string>(
            "--memory",
            [&run](const std::string& text) {
                const auto bytes = parse_bytes(text);
                if (!bytes) throw RefusedValue("--memory", bytes.error());
                run.memory_bytes = *bytes;
                set_decode_limit_bytes(*bytes / 2);  // before the first image is opened
            },
            "Memory limit (3G, 800M): fewer frames are processed at the same time")
        ->type_name("BYTES");
}

void add_stage_flag(CLI::App& command, RunOptions& run) {
    command
        .add_option_function<std::string>(
            "--stage",
            [&run](const std::string& text) {
                const auto stage = parse_job_stage(text);
                if (!stage) throw RefusedValue("--stage", stage.error());
                run.stage = *stage;
            },
            "One stage of the render, for a farm: motion, analyse, planes, frames, encode [all]")
        ->type_name("NAME");
}

// For other programs.
void add_export_flags(CLI::App& command, RunOptions& run) {
    command
        .add_option("--export-plane", run.plane,
                    "Also write the texture plane, unlit, as a picture: .png (16 bit) or .exr")
        ->type_name("PATH");
    command
        .add_option("--export-st-maps", run.st_maps,
                    "Also write ST-maps between the reference frame and each frame "
                    "('st/####.exr')")
        ->type_name("PATH");
    command
        .add_option("--export-composite", run.composites,
                    "Also write a node tree that rebuilds the frames from plate and layers: for "
                    "Nuke (.nk), Fusion (.comp) or Blender (.py); repeatable")
        ->type_name("PATH")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace

void add_project_path(CLI::App& command, std::string& path) {
    command.add_option("project", path, "Project file (.weft)")->required()->type_name("PATH");
}

void add_threads_flag(CLI::App& command, int& threads) {
    constexpr int kMostThreads = 1024;
    command
        .add_option("--threads", threads, "Number of threads, 0 to 1024; 0 is one per processor")
        ->transform(whole_number(0, kMostThreads))
        ->type_name("N");
}

std::shared_ptr<std::string> add_library_flag(CLI::App& command) {
    auto library = std::make_shared<std::string>();
    add_library_option(command, *library);
    return library;
}

void add_progress_flag(CLI::App& command, RunOptions& run) {
    command.add_option("--progress", run.progress, "plain, json, openjd or none [plain]")
        ->transform(choice<ProgressStyle>({{"plain", ProgressStyle::kPlain},
                                           {"json", ProgressStyle::kJson},
                                           {"none", ProgressStyle::kNone},
                                           {"openjd", ProgressStyle::kOpenJd}}))
        ->type_name("STYLE");
}

void add_map_flag(CLI::App& command, RunOptions& run) {
    command
        .add_option_function<std::vector<std::string>>(
            "--map",
            [&run](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) {
                    const auto map = parse_root_map(text);
                    if (!map) throw RefusedValue("--map", map.error());
                    run.maps.push_back(*map);
                }
            },
            "FROM=TO: replace the start FROM of paths by TO; repeatable")
        ->type_name("FROM=TO")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::string assets_folder() {
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    const auto installed = program.parent_path().parent_path() / "share" / "weft" / "assets";
    if (!error && std::filesystem::exists(installed, error)) return installed.string();
    return WEFT_ASSETS_DIR;
}

void add_trust_flag(CLI::App& command, bool& trust) {
    command.add_flag("--trust", trust,
                     "Let the project write outside its folder in this run ('weft trust')");
}

void add_analysis_flags(CLI::App& command, RunOptions& run) {
    add_threads_flag(command, run.threads);
    command.add_option("--cache", run.cache.folder, "Folder of the analysis cache [~/.cache/weft]")
        ->type_name("PATH");
    command.add_flag_callback(
        "--no-cache", [&run] { run.cache.keep = false; }, "Do not cache the analysis");
}

void add_run_flags(CLI::App& command, RunOptions& run, bool renders) {
    add_analysis_flags(command, run);
    command.add_flag("--overwrite", run.overwrite, "Replace existing output files");
    add_output_root_flag(command, run.output_root);
    add_progress_flag(command, run);
    if (!renders) return;
    command.add_flag("--skip-existing", run.skip_existing,
                     "Keep existing frames that are readable");
    command.add_flag("--resume", run.resume,
                     "Keep existing frames of the same settings and inputs");
    add_map_flag(command, run);
    add_stage_flag(command, run);
    command.add_flag("--version-up", run.version_up,
                     "Write to the next free version: v003 in the output's path becomes v004");
    command.add_flag("--restart", run.overwrite, "Same as --overwrite: render all frames again");
    command.add_option("--recipe", run.recipe, "Write the recipe for 'weft verify' here")
        ->type_name("PATH");
    add_export_flags(command, run);
    add_memory_flag(command, run);
    add_library_option(command, run.texture_library);
    command.add_option("--backend", run.backend, "auto, cpu or cuda [auto]")->type_name("NAME");
    command.add_option("--report", run.report, "Write a JSON report here")->type_name("PATH");
    command.add_flag("--dry-run", run.dry_run, "Print what would be rendered, and stop");
}

}  // namespace weft
