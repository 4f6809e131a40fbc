// weft replace, render, matte and demo.

#include "app/cli/command_line.h"
#include "app/cli/commands.h"
#include "app/cli/option_values.h"
#include "app/cli/region_flags.h"
#include "app/project/codec/project_file.h"

namespace weft {
namespace {

// Relative paths of `project` refer to the current folder.
CommandResult run_render(const Project& project, const RunOptions& run) {
    WEFT_CHECK_OK(check_document(project));
    return render_command(project, run);
}

void add_replace(CLI::App& app, CommandResult& result) {
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
    on_run(*command, result, [=]() -> CommandResult {
        WEFT_TRY(project, flags->project());
        return run_render(project, *run);
    });
}

void add_render(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand("render", "Render a project");
    const auto run = std::make_shared<RunOptions>();
    const auto path = std::make_shared<std::string>();
    add_project_path(*command, *path);
    const auto flags = std::make_shared<ProjectFlags>(
        *command, ProjectFlags::Which{false, true, true, false, false});
    add_run_flags(*command, *run, true);
    add_trust_flag(*command, run->by_user.trust);
    command->footer(
        "Settings given here apply to this run only.\n"
        "Examples:\n"
        "  weft render shot.weft\n"
        "  weft render shot.weft --frames 1010-1020 --quality draft -o '/tmp/look/####.jpg'\n"
        "  weft render shot.weft --skip-existing --progress json");
    on_run(*command, result, [=]() -> CommandResult {
        run->reads = {*path};
        run->project_file = *path;
        run->by_user.frames = flags->given("output.path");
        run->by_user.layers = flags->given("output.layers_path");
        run->by_user.movie = flags->given("output.movie");
        WEFT_TRY(written, load_project(*path));
        Project project = resolve_paths(written, project_dir(*path));
        WEFT_CHECK_OK(flags->apply(project));
        return run_render(project, *run);
    });
}

void add_matte(CLI::App& app, CommandResult& result) {
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
        "Prints the confidence of each frame; add keyframes where it is low.\n"
        "Examples:\n"
        "  weft matte --plate 'frames/####.png' --matte 12=a.png -o 'mattes/####.png'\n"
        "  weft matte --plate shot.mp4 --matte 1012=a.png --matte 1040=b.png -o 'mattes/####.png' "
        "--frames 1001-1050");
    on_run(*command, result, [=]() -> CommandResult {
        WEFT_TRY(project, flags->project());
        return matte_command(project, *output, *run);
    });
}

}  // namespace

void add_render_commands(CLI::App& app, CommandResult& result) {
    add_replace(app, result);
    add_render(app, result);
    add_matte(app, result);
}

}  // namespace weft
