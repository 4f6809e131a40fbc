#pragma once
// Command-line flags out of the parameter tables (app/project/parameters.h).

#include <CLI/CLI.hpp>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/edit_command.h"
#include "app/project/parameters.h"

namespace weft {

/// Flags of one subcommand for everything that a project and a region hold, and what was given.
class ProjectFlags {
  public:
    /// Which flags a subcommand has.
    struct Which {
        bool plate = true, output = true, render = true, matte = true, region = true;
    };
    ProjectFlags(CLI::App& command, const Which& which);

    /// Sets whatever was given on the command line. Errors: Usage.
    [[nodiscard]] Status apply(Project& project) const;
    [[nodiscard]] Status apply(Region& region) const;
    /// A project of one region out of the flags alone, paths as given.
    [[nodiscard]] Expected<Project> project() const;

  private:
    template <class Owner>
    struct Given {
        const Parameter<Owner>* parameter;
        std::vector<std::string> texts;
        bool flag = false;  ///< --flag, or --flag=false
        const CLI::Option* option = nullptr;
    };
    template <class Owner>
    void add(CLI::App& command, const Parameter<Owner>& parameter, std::list<Given<Owner>>& into);

    std::list<Given<Project>> project_;  // a list: CLI11 keeps pointers to the entries
    std::list<Given<Region>> region_;
    std::vector<std::string> mattes_, holdouts_;
    std::string crypto_files_;
};

/// --db: where textures "db:ID" are; empty: the user's own library.
[[nodiscard]] std::shared_ptr<std::string> add_library_flag(CLI::App& command);
/// --map.
void add_map_flag(CLI::App& command, RunOptions& run);
/// Where the demo and the other assets are: beside an installed program, else in the sources.
[[nodiscard]] std::string assets_folder();
/// --progress and --json.
void add_progress_flags(CLI::App& command, RunOptions& run);
/// --threads, --backend, --progress and the like.
void add_run_flags(CLI::App& command, RunOptions& run, bool renders);

// Each file of subcommands adds its own; `exit` receives the exit code of the one that ran.
void add_render_commands(CLI::App& app, int& exit);
void add_project_commands(CLI::App& app, int& exit);
void add_synth_commands(CLI::App& app, int& exit);
void add_tool_commands(CLI::App& app, int& exit);
void add_edit_command(CLI::App& app, int& exit, const EditCommand& edit);
void add_studio_commands(CLI::App& app, int& exit);
void add_study_command(CLI::App& app, int& exit);

}  // namespace weft
