#pragma once
// Declares the commands for CLI11, with helpers that their files share. Each add_…() adds
// subcommands that store their answer in `result`.

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>

#include "app/cli/answer.h"
#include "app/cli/edit_command.h"
#include "app/cli/write_flags.h"

namespace weft {

struct RunOptions;

/// Adds all commands, each with --help and --json.
void add_commands(CLI::App& app, CommandResult& result, const EditCommand& edit);

void add_render_commands(CLI::App& app, CommandResult& result);
void add_flatten_command(CLI::App& app, CommandResult& result);
void add_form_command(CLI::App& app, CommandResult& result);
void add_motion_command(CLI::App& app, CommandResult& result);
void add_project_commands(CLI::App& app, CommandResult& result);
void add_synth_commands(CLI::App& app, CommandResult& result);
void add_tool_commands(CLI::App& app, CommandResult& result);
void add_edit_command(CLI::App& app, CommandResult& result, const EditCommand& edit);
void add_texture_commands(CLI::App& app, CommandResult& result);
void add_studio_commands(CLI::App& app, CommandResult& result);
void add_study_command(CLI::App& app, CommandResult& result);
void add_trust_command(CLI::App& app, CommandResult& result);

/// Runs `body` when the command is chosen and stores its result.
template <class Body>
void on_run(CLI::App& command, CommandResult& result, Body body) {
    command.callback([&result, body = std::move(body)] { result = body(); });
}

/// --trust: lets the project write outside its folder in this run.
void add_trust_flag(CLI::App& command, bool& trust);
/// The required first argument of most commands.
void add_project_path(CLI::App& command, std::string& path);
/// --threads; 0 means one per processor.
void add_threads_flag(CLI::App& command, int& threads);
/// --db: the library of textures "db:ID"; empty: the user's own.
[[nodiscard]] std::shared_ptr<std::string> add_library_flag(CLI::App& command);
/// --map.
void add_map_flag(CLI::App& command, RunOptions& run);
/// --progress.
void add_progress_flag(CLI::App& command, RunOptions& run);
/// --threads, --cache and --no-cache.
void add_analysis_flags(CLI::App& command, RunOptions& run);
/// --threads, --backend, --progress and the like.
void add_run_flags(CLI::App& command, RunOptions& run, bool renders);
/// The folder of the demo and other assets: beside an installed program, otherwise in the source
/// tree.
[[nodiscard]] std::string assets_folder();

}  // namespace weft
