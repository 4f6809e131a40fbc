#pragma once
// The commands as CLI11 knows them, and what their files share. Each add_…() adds subcommands whose
// answer goes to `result` when one of them is run.

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>

#include "app/cli/answer.h"
#include "app/cli/edit_command.h"
#include "app/cli/write_flags.h"

namespace weft {

struct RunOptions;

/// The whole command line: every command, its --help and --json.
void add_commands(CLI::App& app, CommandResult& result, const EditCommand& edit);

void add_render_commands(CLI::App& app, CommandResult& result);
void add_project_commands(CLI::App& app, CommandResult& result);
void add_synth_commands(CLI::App& app, CommandResult& result);
void add_tool_commands(CLI::App& app, CommandResult& result);
void add_edit_command(CLI::App& app, CommandResult& result, const EditCommand& edit);
void add_texture_commands(CLI::App& app, CommandResult& result);
void add_studio_commands(CLI::App& app, CommandResult& result);
void add_study_command(CLI::App& app, CommandResult& result);
void add_trust_command(CLI::App& app, CommandResult& result);

/// `body` is run when the command is chosen, and returns its result.
template <class Body>
void on_run(CLI::App& command, CommandResult& result, Body body) {
    command.callback([&result, body = std::move(body)] { result = body(); });
}

/// --trust: for this run the project may write outside of its folder.
void add_trust_flag(CLI::App& command, bool& trust);
/// The required first argument of most commands.
void add_project_path(CLI::App& command, std::string& path);
/// --threads; 0 is one for each processor.
void add_threads_flag(CLI::App& command, int& threads);
/// --db: where textures "db:ID" are; empty: the user's own library.
[[nodiscard]] std::shared_ptr<std::string> add_library_flag(CLI::App& command);
/// --map.
void add_map_flag(CLI::App& command, RunOptions& run);
/// --progress.
void add_progress_flag(CLI::App& command, RunOptions& run);
/// --threads, --backend, --progress and the like.
void add_run_flags(CLI::App& command, RunOptions& run, bool renders);
/// Where the demo and the other assets are: beside an installed program, else in the sources.
[[nodiscard]] std::string assets_folder();

}  // namespace weft
