// weft replace, render, matte and demo.

#include "app/cli/region_flags.h"
#include "app/project/project_file.h"
#include "app/project/validate.h"

namespace weft {
namespace {

// The project with absolute meaning, or the exit code of what is wrong with it.
int run_render(const Expected<Project>& project, const std::string& dir, const RunOptions& run) {
    if (!project) return report_error(project.error());
    if (project->output.path.empty()) {
        return report_error({ErrorCode::kUsage,
                             "No output is set. Give a pattern with -o, such as 'out/####.png'.",
                             {}});
    }
    for (const Issue& issue : validate(*project)) {
        if (issue.severity == Severity::kError)
            return report_error({ErrorCode::kUsage, issue.text(), {}});
        print_warning(issue.text());
    }
    return render_command(resolve_paths(*project, dir), run);
}

void add_replace(CLI::App& app, int& exit) {
    CLI::App* command = app.add_subcommand("replace", "Replace a surface's texture in a shot");
    const auto run = std::make_shared<RunOptions>();
    const auto flags = std::make_shared<ProjectFlags>(*command, ProjectFlags::Which{});
    add_run_flags(*command, *run, true);
    command->footer(
        "Examples:\n"
        "  weft replace --plate 'frames/####.png' --matte 'masks/####.png' --texture wool.jpg -o "
        "'out/####.png'\n"
        "  weft replace --plate shot.mp4 --matte 1012=a.png --matte 1040=b.png --texture brick.jpg "
        "--scale 1.5 \\\n"
        "               -o 'out/####.png' --movie review.mp4\n"
        "  weft replace --plate 'cg/####.exr' --matte 'ids/####.png' --matte-value 2 --motion "
        "'flow/####.flo' \\\n"
        "               --plane tiles.png --light-strength 0.8 -o 'out/####.exr' --report "
        "report.json");
    command->callback([=, &exit] { exit = run_render(flags->project(), "", *run); });
}

void add_render(CLI::App& app, int& exit) {
    CLI::App* command = app.add_subcommand("render", "Render a project");
    const auto run = std::make_shared<RunOptions>();
    const auto path = std::make_shared<std::string>();
    command->add_option("project", *path, "Project file (.weft)")->required()->type_name("PATH");
    const auto flags = std::make_shared<ProjectFlags>(
        *command, ProjectFlags::Which{false, true, true, false, false});
    add_run_flags(*command, *run, true);
    command->footer(
        "Settings given here hold for this run only.\n"
        "Examples:\n"
        "  weft render shot.weft\n"
        "  weft render shot.weft --frames 1010-1020 --quality draft -o '/tmp/look/####.jpg'\n"
        "  weft render shot.weft --skip-existing --progress json");
    command->callback([=, &exit] {
        auto project = load_project(*path);
        if (project) *project = resolve_paths(*project, project_dir(*path));
        if (project) {
            if (Status status = flags->apply(*project); !status) {
                exit = report_error(status.error());
                return;
            }
        }
        exit = run_render(project, "", *run);
    });
}

void add_matte(CLI::App& app, int& exit) {
    CLI::App* command = app.add_subcommand("matte", "Propagate painted mattes through a shot");
    const auto run = std::make_shared<RunOptions>();
    const auto output = std::make_shared<std::string>();
    const auto flags = std::make_shared<ProjectFlags>(
        *command, ProjectFlags::Which{true, false, false, true, false});
    command
        ->add_option("-o,--output", *output, "Pattern of the mattes to write ('mattes/####.png')")
        ->required()
        ->type_name("PATH");
    add_run_flags(*command, *run, false);
    command->footer(
        "Prints the confidence of each frame: low ones want a keyframe.\n"
        "Examples:\n"
        "  weft matte --plate 'frames/####.png' --matte 12=a.png -o 'mattes/####.png'\n"
        "  weft matte --plate shot.mp4 --matte 1012=a.png --matte 1040=b.png -o 'mattes/####.png' "
        "--frames 1001-1050");
    command->callback([=, &exit] {
        const auto project = flags->project();
        exit = project ? matte_command(*project, *output, *run) : report_error(project.error());
    });
}

}  // namespace

void add_render_commands(CLI::App& app, int& exit) {
    add_replace(app, exit);
    add_render(app, exit);
    add_matte(app, exit);
}

}  // namespace weft
