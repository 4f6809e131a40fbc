// weft measure, diff and demo.

#include "app/cli/command_line.h"
#include "app/cli/commands.h"
#include "app/cli/option_values.h"
#include "app/cli/region_flags.h"
#include "app/project/codec/project_file.h"

namespace weft {
namespace {

// What a result can be compared with.
void add_comparisons(CLI::App& command, MeasureCommandOptions& options) {
    command
        .add_option("--truth", options.truth,
                    "The same scene rendered with the new material ('true/####.png')")
        ->type_name("PATH");
    command
        .add_option("--truth-blur", options.truth_blur_px,
                    "Blur both by a Gaussian of this many px before comparing [0]")
        ->check(number(0.0, 100.0))
        ->type_name("PX");
    command
        .add_option("--st", options.st,
                    "EXRs of the render with the layer st: how the texture lies on the surface of "
                    "--position-pass")
        ->type_name("PATH");
}

void add_measure(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand(
        "measure", "Measure flicker, sharpness, drift, light and form of a result");
    const auto options = std::make_shared<MeasureCommandOptions>();
    command->add_option("--result", options->result, "The rendered frames ('out/####.png')")
        ->required()
        ->type_name("PATH");
    const auto flags = std::make_shared<ProjectFlags>(
        *command, ProjectFlags::Which{true, false, true, true, true});
    command->add_option("--out-space", options->project.color.out_space,
                        "Colour space of the result");
    command
        ->add_option("--estimator", options->estimator,
                     "Motion estimator without --motion: deepflow or farneback [deepflow]")
        ->transform(choice<MeasuringEstimator>({{"deepflow", MeasuringEstimator::kDeepFlow},
                                                {"farneback", MeasuringEstimator::kFarneback}}))
        ->type_name("");
    add_comparisons(*command, *options);
    command
        ->add_option("--light-pictures", options->pictures,
                     "Folder for images of light and reflectance, before and after")
        ->type_name("PATH");
    add_write_flags(*command, options->write);
    command->add_option("--cache", options->cache, "Folder of the analysis cache")
        ->type_name("PATH");
    add_threads_flag(*command, options->threads);
    command->footer(
        "With --albedo or --lighting the light that Weft estimates is compared with the true one.\n"
        "With --position-pass, --st and --plane the texture's stretch on the true surface is "
        "measured.\n"
        "With --motion (true motion) and the texture and placement of the render, the floor of the "
        "TDE and the\n"
        "sharpness kept are measured too. Light is part of the picture: render with --light none "
        "to judge\n"
        "transport alone.\n"
        "Examples:\n"
        "  weft measure --result 'out/####.png' --plate 'frames/####.png' --matte "
        "'masks/####.png'\n"
        "  weft measure --result 'out/####.png' --plate 'frames/####.png' --matte 'ids/####.png' "
        "--matte-value 2 \\\n"
        "               --motion 'flow/####.png' --plane plane.png --json");
    on_run(*command, result, [=]() -> CommandResult {
        const std::string out_space = options->project.color.out_space;
        WEFT_TRY(project, flags->project());
        project.color.out_space = out_space;
        options->project = std::move(project);
        return measure_command(*options);
    });
}

void add_diff(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand("diff", "Compare two sequences, images or movies");
    const auto options = std::make_shared<DiffOptions>();
    command->add_option("a", options->a, "One sequence")->required()->type_name("PATH");
    command->add_option("b", options->b, "The other")->required()->type_name("PATH");
    command->add_option("--frames", options->frames, "Frames to compare");
    command
        ->add_option("--tolerance", options->tolerance,
                     "Largest difference that counts as equal, white = 1 [0]")
        ->check(number(0, std::numeric_limits<double>::max()))
        ->type_name("");
    command
        ->add_option("--matte", options->matte,
                     "Matte of the surface: also measures the offset of its features and the "
                     "difference inside and in the soft edge")
        ->type_name("PATTERN");
    command->add_option("--matte-value", options->matte_value, "Id matte: where the pixel equals N")
        ->transform(whole_number())
        ->type_name("N");
    command->add_option("--matte-channel", options->matte_channel, "R, G, B, A, Y or a name")
        ->type_name("");
    command
        ->add_option("--worst", options->worst,
                     "Image of the ten worst crops to write, with --matte: the first sequence "
                     "above, the second below it, the difference at the bottom")
        ->type_name("FILE");
    add_write_flags(*command, options->write);
    command->footer(
        "Exit code 0 if they are equal, 8 if they differ.\n"
        "Examples:\n  weft diff 'out/####.png' 'retake/####.png'\n"
        "  weft diff 'second_rendering/####.png' 'out/####.png' --matte 'mattes/####.png' "
        "--worst worst.png");
    on_run(*command, result, [=] { return diff_command(*options); });
}

void add_cryptomatte(CLI::App& app, CommandResult& result) {
    CLI::App* command =
        app.add_subcommand("cryptomatte", "List a frame's Cryptomatte objects, or pick one");
    const auto path = std::make_shared<std::string>(), at = std::make_shared<std::string>();
    command->add_option("file", *path, "EXR with a Cryptomatte")->required()->type_name("PATH");
    command->add_option("--at", *at, "X,Y: the object that covers most of this pixel")
        ->type_name("");
    command->footer(
        "Examples:\n  weft cryptomatte cg/0001.exr\n  weft cryptomatte cg/0001.exr --at 320,180");
    on_run(*command, result, [=] { return cryptomatte_command(*path, *at); });
}

void add_verify(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand("verify", "Verify frames from their recipe");
    const auto run = std::make_shared<RunOptions>();
    const auto options = std::make_shared<VerifyCommandOptions>();
    run->cache.keep = false;
    command->add_option("recipe", options->recipe, "File that --recipe wrote")
        ->required()
        ->type_name("PATH");
    command->add_option("--frames", options->frames, "Frames to verify [all of the recipe]");
    command->add_flag("--quick", options->quick, "Compare hashes only, render nothing");
    add_threads_flag(*command, run->threads);
    add_progress_flag(*command, *run);
    command->footer(
        "Compares every input and every frame with the hashes of the recipe, and renders the "
        "frames again\ninto a private folder. Exit code 0 if all bytes are equal, 8 if "
        "some differ.\n"
        "Examples:\n  weft render shot.weft --recipe shot.recipe.json\n"
        "  weft verify shot.recipe.json --frames 1001,1048");
    on_run(*command, result, [=] { return verify_command(*options, *run); });
}

void add_demo(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand("demo", "Render the demo shot");
    const auto run = std::make_shared<RunOptions>();
    const auto assets = std::make_shared<std::string>(assets_folder());
    const auto output = std::make_shared<std::string>();
    command->add_option("-o,--output", *output, "Folder to write [weft-demo]")->type_name("PATH");
    command->add_option("--assets", *assets, "Folder of the demo's assets")->type_name("PATH");
    add_run_flags(*command, *run, true);
    command->footer("Example:\n  weft demo -o /tmp/demo --overwrite");
    on_run(*command, result, [=] { return demo_command(*assets, *output, *run); });
}

}  // namespace

void add_tool_commands(CLI::App& app, CommandResult& result) {
    add_measure(app, result);
    add_diff(app, result);
    add_cryptomatte(app, result);
    add_verify(app, result);
    add_demo(app, result);
}

}  // namespace weft
