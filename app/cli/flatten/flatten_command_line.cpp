#include "app/cli/command_line.h"
#include "app/cli/commands.h"
#include "app/cli/flatten/flatten_command.h"
#include "app/cli/option_values.h"
#include "app/exchange/flat_picture.h"
#include "app/project/codec/project_file.h"
#include "engine/core/frame_range.h"

namespace weft {
namespace {

struct FlattenFlags {
    FlattenSpec spec;
    RunOptions run;
    std::string project, back;
};

void add_flatten_flags(CLI::App& command, FlattenFlags& flags) {
    command
        .add_option("-o,--output", flags.spec.path,
                    "Picture to write: .ora (with layers), .png, .tif, "
                    ".exr")
        ->type_name("FILE");
    command.add_option("--back", flags.back, "Take a painted picture back as the region's texture")
        ->type_name("FILE");
    command.add_option("--region", flags.spec.region, "Name or id of the region [the only one]")
        ->type_name("NAME");
    command
        .add_option("--texels", flags.spec.scale,
                    "Texels a plate pixel, 1 or 2 [2 for plates up to 2048 px wide]")
        ->transform(whole_number(1, kMostFlatScale))
        ->type_name("N");
    command
        .add_option("--margin", flags.spec.margin_px,
                    "Plate pixels around the reference frame [what other frames show beyond it]")
        ->transform(whole_number(0, 100'000))
        ->type_name("PX");
    command.add_option("--frames", flags.spec.frames,
                       "Frames to gather from [up to 32 of all of the project]");
}

CommandResult run_flatten_flags(FlattenFlags& flags) {
    FlattenSpec& spec = flags.spec;
    if (!flags.back.empty() && !spec.path.empty())
        return fail(ErrorCode::kUsage, "-o and --back contradict each other.", "Leave one out.");
    if (!flags.back.empty()) {
        WEFT_TRY(project, load_project(flags.project));
        if (spec.region.empty() && project.regions.size() == 1)
            spec.region = project.regions.front()->name;
        if (spec.region.empty())
            return fail(ErrorCode::kUsage,
                        "The project has " + std::to_string(project.regions.size()) +
                            " regions, and the picture is of one.",
                        "Choose it with --region.");
        return flatten_back_command(flags.project, spec.region, flags.back);
    }
    if (spec.path.empty())
        return fail(ErrorCode::kUsage, "No picture is named.",
                    "Give -o FILE to write one, or --back FILE to take one back.");
    spec.overwrite = flags.run.overwrite;
    spec.cache = flags.run.cache;
    spec.threads = flags.run.threads;
    spec.limits = {flags.run.output_root, {flags.project}};
    WEFT_TRY(written, load_project(flags.project));
    spec.project = resolve_paths(written, project_dir(flags.project));
    return flatten_command(spec, flags.run.progress);
}

}  // namespace

void add_flatten_command(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand(
        "flatten",
        "Write a region's surface as one still, unlit picture, and take it back painted");
    const auto flags = std::make_shared<FlattenFlags>();
    add_project_path(*command, flags->project);
    add_flatten_flags(*command, *flags);
    add_analysis_flags(*command, flags->run);
    const auto library = add_library_flag(*command);
    command->add_flag("--overwrite", flags->run.overwrite, "Replace an existing picture");
    add_output_root_flag(*command, flags->run.output_root);
    add_progress_flag(*command, flags->run);
    command->footer(
        "The size of the picture says where it lies: paint on it, but neither crop nor scale it.\n"
        "Examples:\n"
        "  weft flatten shot.weft --region wall -o wall.ora\n"
        "  krita wall.ora\n"
        "  weft flatten shot.weft --region wall --back wall.ora\n"
        "  weft render shot.weft");
    on_run(*command, result, [=] {
        flags->spec.texture_library = *library;
        return run_flatten_flags(*flags);
    });
}

}  // namespace weft
