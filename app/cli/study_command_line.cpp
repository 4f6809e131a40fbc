// weft study.

#include "app/cli/command_line.h"
#include "app/cli/commands.h"
#include "app/cli/option_values.h"
#include "app/cli/region_flags.h"

namespace weft {

void add_study_command(CLI::App& app, CommandResult& result) {
    CLI::App* command =
        app.add_subcommand("study", "Compare methods on one clip and write a report");
    const auto options = std::make_shared<StudyOptions>();
    const auto run = std::make_shared<RunOptions>();
    const auto flags = std::make_shared<ProjectFlags>(
        *command, ProjectFlags::Which{true, false, true, true, true});
    command->add_option("-o,--output", options->folder, "Folder to write")
        ->required()
        ->type_name("PATH");
    command
        ->add_option("--methods", options->methods,
                     "anew, patchmatch, poisson, still, paper, locked, light, ablation [all]")
        ->delimiter(',')
        ->type_name("");
    command
        ->add_option("--alphas", options->alphas,
                     "Values of α for the paper mode, 0 to 1 [0.2,0.5,1]")
        ->delimiter(',')
        ->check(number(0.0, 1.0))
        ->type_name("");
    command->add_flag("--render-with-motion", options->render_with_motion,
                      "Also render with --motion, instead of only measuring with it");
    add_threads_flag(*command, run->threads);
    command->add_flag("--overwrite", run->overwrite, "Replace an earlier report and its frames");
    add_output_root_flag(*command, run->output_root);
    add_progress_flag(*command, *run);
    const auto library = add_library_flag(*command);
    command->footer(
        "Writes report.html (self-contained), report.json, report.csv and the "
        "frames of every\n"
        "method. --temporal, --temporal-blend, --seam and --light none are the study's own "
        "business.\n"
        "Example:\n"
        "  weft study --plate 'frames/####.png' --matte 'masks/####.png' --texture brick.jpg \\\n"
        "             --motion 'flow/####.png' --frames 1-24 -o study");
    on_run(*command, result, [=]() -> CommandResult {
        WEFT_TRY(project, flags->project());
        options->project = std::move(project);
        options->threads = run->threads;
        options->texture_library = *library;
        options->overwrite = run->overwrite;
        options->limits.root = run->output_root;
        return study_command(*options, *run);
    });
}

}  // namespace weft
