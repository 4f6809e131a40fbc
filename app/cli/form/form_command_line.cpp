#include "app/cli/command_line.h"
#include "app/cli/form/form_command.h"
#include "app/cli/region_flags.h"
#include "app/project/codec/project_file.h"

namespace weft {

void add_form_command(CLI::App& app, CommandResult& result) {
    CLI::App* command =
        app.add_subcommand("form", "Print the form that is found for each surface of a shot");
    const auto run = std::make_shared<RunOptions>();
    const auto path = std::make_shared<std::string>();
    command->add_option("project", *path, "Project file (.weft); or give --plate and --matte")
        ->type_name("PATH");
    const auto flags = std::make_shared<ProjectFlags>(
        *command, ProjectFlags::Which{true, false, true, true, true});
    add_analysis_flags(*command, *run);
    add_progress_flag(*command, *run);
    command->footer(
        "Nothing is rendered; what is found is kept for the render.\n"
        "Examples:\n"
        "  weft form shot.weft\n"
        "  weft form --plate 'frames/####.png' --matte 'masks/####.png' --fov 47 --json");
    on_run(*command, result, [=]() -> CommandResult {
        if (path->empty()) {
            WEFT_TRY(project, flags->project());
            return form_command(project, *run);
        }
        if (flags->gives_region()) {
            return fail(ErrorCode::kUsage,
                        "A project has its own mattes, motion and form, and options for them were "
                        "given beside " +
                            *path + ".",
                        "Change a region with 'weft region set', or leave the project or these "
                        "options out.");
        }
        WEFT_TRY(written, load_project(*path));
        Project project = resolve_paths(written, project_dir(*path));
        WEFT_CHECK_OK(flags->apply(project));
        return form_command(project, *run);
    });
}

}  // namespace weft
