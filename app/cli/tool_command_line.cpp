// weft measure, diff and demo.

#include "app/cli/region_flags.h"
#include "app/project/project_file.h"

namespace weft {
namespace {

void add_measure(CLI::App& app, int& exit) {
    CLI::App* command =
        app.add_subcommand("measure", "Measure flicker, sharpness, drift and light of a result");
    const auto options = std::make_shared<MeasureCommandOptions>();
    command->add_option("--result", options->result, "The rendered frames ('out/####.png')")
        ->required()
        ->type_name("PATH");
    const auto flags = std::make_shared<ProjectFlags>(
        *command, ProjectFlags::Which{true, false, true, true, true});
    command->add_option("--out-space", options->project.color.out_space,
                        "Colour space of the result");
    command
        ->add_option("--estimator", options->motion_estimator,
                     "Motion to measure with where none is given: deepflow or farneback [deepflow]")
        ->check(CLI::IsMember({"deepflow", "farneback"}))
        ->type_name("");
    command
        ->add_option("--truth", options->truth,
                     "The same scene rendered with the new material ('true/####.png')")
        ->type_name("PATH");
    command
        ->add_option("--truth-blur", options->truth_blur_px,
                     "Compare with the truth after a Gaussian of this many px [0]")
        ->check(CLI::Range(0.0, 100.0))
        ->type_name("PX");
    command
        ->add_option("--light-pictures", options->pictures,
                     "Folder for pictures of the light and the reflectance, before and after")
        ->type_name("PATH");
    command->add_option("--cache", options->cache, "Where analyses are kept")->type_name("PATH");
    command->add_option("--threads", options->threads, "Threads to use; 0 is one a processor")
        ->check(CLI::Range(0, 1024));
    command->add_flag("--json", options->json, "One JSON object on stdout");
    command->footer(
        "With --albedo or --lighting the light that Weft estimates is compared with the true one.\n"
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
    command->callback([=, &exit] {
        const std::string out_space = options->project.color.out_space;
        auto project = flags->project();
        if (!project) {
            exit = report_error(project.error());
            return;
        }
        project->color.out_space = out_space;
        options->project = std::move(*project);
        exit = measure_command(*options);
    });
}

void add_diff(CLI::App& app, int& exit) {
    CLI::App* command = app.add_subcommand("diff", "Compare two sequences, pictures or movies");
    const auto options = std::make_shared<DiffOptions>();
    command->add_option("a", options->a, "One sequence")->required()->type_name("PATH");
    command->add_option("b", options->b, "The other")->required()->type_name("PATH");
    command->add_option("--frames", options->frames, "Frames to compare");
    command
        ->add_option("--tolerance", options->tolerance,
                     "Largest difference that counts as the same, white = 1 [0]")
        ->check(CLI::NonNegativeNumber)
        ->type_name("");
    command
        ->add_option("--matte", options->matte,
                     "Matte of what should look alike: says how far its features are off, and what "
                     "differs inside and in the soft edge")
        ->type_name("PATTERN");
    command->add_option("--matte-value", options->matte_value, "Id matte: where the pixel equals N")
        ->type_name("N");
    command->add_option("--matte-channel", options->matte_channel, "R, G, B, A, Y or a name")
        ->type_name("");
    command
        ->add_option("--worst", options->worst,
                     "Picture of the ten worst crops to write, with --matte: the first sequence "
                     "above, the second below it, the difference at the bottom")
        ->type_name("FILE");
    command->add_flag("--json", options->json, "One JSON object on stdout");
    command->footer(
        "Exit code 0 when they are the same, 8 when they differ.\n"
        "Examples:\n  weft diff 'out/####.png' 'retake/####.png'\n"
        "  weft diff 'second_rendering/####.png' 'out/####.png' --matte 'mattes/####.png' "
        "--worst worst.png");
    command->callback([=, &exit] { exit = diff_command(*options); });
}

void add_cryptomatte(CLI::App& app, int& exit) {
    CLI::App* command =
        app.add_subcommand("cryptomatte", "List a frame's Cryptomatte objects, or pick one");
    const auto path = std::make_shared<std::string>(), at = std::make_shared<std::string>();
    const auto json = std::make_shared<bool>(false);
    command->add_option("file", *path, "EXR with a Cryptomatte")->required()->type_name("PATH");
    command->add_option("--at", *at, "X,Y: the object that covers most of this pixel")
        ->type_name("");
    command->add_flag("--json", *json, "As JSON");
    command->footer(
        "Examples:\n  weft cryptomatte cg/0001.exr\n  weft cryptomatte cg/0001.exr --at 320,180");
    command->callback([=, &exit] { exit = cryptomatte_command(*path, *at, *json); });
}

void add_verify(CLI::App& app, int& exit) {
    CLI::App* command =
        app.add_subcommand("verify", "Prove that frames are what their recipe gives");
    const auto run = std::make_shared<RunOptions>();
    const auto options = std::make_shared<VerifyCommandOptions>();
    run->cache.keep = false;
    command->add_option("recipe", options->recipe, "File that --recipe wrote")
        ->required()
        ->type_name("PATH");
    command->add_option("--frames", options->frames, "Frames to verify [all of the recipe]");
    command->add_flag("--quick", options->quick, "Compare hashes only, render nothing");
    command->add_option("--threads", run->threads, "Threads to use; 0 is one a processor")
        ->check(CLI::Range(0, 1024));
    add_progress_flags(*command, *run);
    command->footer(
        "Compares every input and every frame with the hashes of the recipe, and renders the "
        "frames again\ninto a private folder. Exit code 0 when all bytes are the same, 8 when "
        "some differ.\n"
        "Examples:\n  weft render shot.weft --recipe shot.recipe.json\n"
        "  weft verify shot.recipe.json --frames 1001,1048");
    command->callback([=, &exit] { exit = verify_command(*options, *run); });
}

void add_demo(CLI::App& app, int& exit) {
    CLI::App* command = app.add_subcommand("demo", "Render the demo shot");
    const auto run = std::make_shared<RunOptions>();
    const auto assets = std::make_shared<std::string>(assets_folder());
    const auto output = std::make_shared<std::string>();
    command->add_option("-o,--output", *output, "Folder to write [weft-demo]")->type_name("PATH");
    command->add_option("--assets", *assets, "Folder of the demo's assets")->type_name("PATH");
    add_run_flags(*command, *run, true);
    command->footer("Example:\n  weft demo -o /tmp/demo --overwrite");
    command->callback([=, &exit] { exit = demo_command(*assets, *output, *run); });
}

}  // namespace

void add_tool_commands(CLI::App& app, int& exit) {
    add_measure(app, exit);
    add_diff(app, exit);
    add_cryptomatte(app, exit);
    add_verify(app, exit);
    add_demo(app, exit);
}

}  // namespace weft
