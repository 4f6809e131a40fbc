// weft study.

#include "app/cli/region_flags.h"

namespace weft {

void add_study_command(CLI::App& app, int& exit) {
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
    command->add_option("--alphas", options->alphas, "Blends of the paper mode [0.2,0.5,1]")
        ->delimiter(',')
        ->type_name("");
    command->add_flag("--render-with-motion", options->render_with_motion,
                      "Render with --motion too, instead of measuring with it only");
    command->add_option("--threads", run->threads, "Threads to use; 0 is one a processor")
        ->check(CLI::Range(0, 1024));
    command->add_flag("--overwrite", run->overwrite, "Replace an earlier report and its frames");
    add_progress_flags(*command, *run);
    const auto library = add_library_flag(*command);
    command->footer(
        "Writes report.html (one file with everything in it), report.json, report.csv and the "
        "frames of every\n"
        "method. --temporal, --temporal-blend, --seam and --light none are the study's own "
        "business.\n"
        "Example:\n"
        "  weft study --plate 'frames/####.png' --matte 'masks/####.png' --texture brick.jpg \\\n"
        "             --motion 'flow/####.png' --frames 1-24 -o study");
    command->callback([=, &exit] {
        auto project = flags->project();
        if (!project) {
            exit = report_error(project.error());
            return;
        }
        options->project = std::move(*project);
        options->threads = run->threads;
        options->texture_library = *library;
        options->overwrite = run->overwrite;
        exit = study_command(*options, *run);
    });
}

}  // namespace weft
