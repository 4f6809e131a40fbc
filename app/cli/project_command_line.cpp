// weft new, region add|set|remove|correct|list, apply, info and validate.

#include <cstdio>

#include "app/cli/command_line.h"
#include "app/cli/commands.h"
#include "app/cli/option_values.h"
#include "app/cli/region_flags.h"
#include "app/project/edit.h"

namespace weft {
namespace {

void add_new(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand("new", "Create a project file");
    const auto path = std::make_shared<std::string>();
    const auto write = std::make_shared<WriteFlags>();
    add_project_path(*command, *path);
    const auto flags = std::make_shared<ProjectFlags>(
        *command, ProjectFlags::Which{true, true, true, false, false});
    add_write_flags(*command, *write);
    command->footer(
        "Relative paths are stored as given, relative to the project file's folder.\n"
        "Example:\n  weft new shot.weft --plate 'frames/####.exr' -o 'out/####.exr' --frames "
        "1001-1048");
    on_run(*command, result, [=]() -> CommandResult {
        Project project;
        WEFT_CHECK_OK(flags->apply(project));
        return new_command(*path, project, *write);
    });
}

void add_region_add(CLI::App& group, CommandResult& result) {
    CLI::App* command = group.add_subcommand("add", "Add a region on top");
    const auto path = std::make_shared<std::string>();
    add_project_path(*command, *path);
    const auto flags = std::make_shared<ProjectFlags>(
        *command, ProjectFlags::Which{false, false, false, true, true});
    command->footer(
        "Example:\n"
        "  weft region add shot.weft --name wall --matte 'masks/wall.####.png' --texture brick.jpg "
        "--scale 1.5");
    const auto library = add_library_flag(*command);
    on_run(*command, result, [=]() -> CommandResult {
        Region region;
        WEFT_CHECK_OK(flags->apply(region));
        return region_add_command(*path, region, *library);
    });
}

void add_region_set(CLI::App& group, CommandResult& result) {
    CLI::App* command = group.add_subcommand("set", "Change a region");
    const auto path = std::make_shared<std::string>(), region = std::make_shared<std::string>();
    add_project_path(*command, *path);
    command->add_option("region", *region, "Name or id of the region")->required();
    const auto flags = std::make_shared<ProjectFlags>(
        *command, ProjectFlags::Which{false, false, false, true, true});
    command->footer(
        "Example:\n  weft region set shot.weft wall --rotate 12 --light-strength 0.7\n"
        "  weft region set shot.weft wall --enabled=false");
    const auto library = add_library_flag(*command);
    on_run(*command, result, [=]() -> CommandResult {
        return region_set_command(
            *path, *region, [&](Region& changed) { return flags->apply(changed); }, *library);
    });
}

void add_region_remove(CLI::App& group, CommandResult& result) {
    CLI::App* command = group.add_subcommand("remove", "Remove a region");
    const auto path = std::make_shared<std::string>(), region = std::make_shared<std::string>();
    add_project_path(*command, *path);
    command->add_option("region", *region, "Name or id of the region")->required();
    command->footer("Example:\n  weft region remove shot.weft wall");
    on_run(*command, result, [=] { return region_remove_command(*path, *region); });
}

// "120,80:132,75": moves the texture at the first point to the second.
Expected<CorrectionPin> pin_from(const std::string& text) {
    CorrectionPin pin;
    int used = 0;
    const int read = std::sscanf(text.c_str(), "%lf,%lf:%lf,%lf%n", &pin.from.x, &pin.from.y,
                                 &pin.to.x, &pin.to.y, &used);
    if (read != 4 || used != static_cast<int>(text.size()))
        return fail(
            ErrorCode::kUsage,
            "--pin must be of the form x,y:x,y in plate pixels (from:to), not '" + text + "'.");
    return pin;
}

void add_region_correct(CLI::App& group, CommandResult& result) {
    CLI::App* command = group.add_subcommand("correct", "Correct a drifted texture on a frame");
    const auto path = std::make_shared<std::string>(), region = std::make_shared<std::string>();
    const auto frame = std::make_shared<int>(0);
    const auto pins = std::make_shared<std::vector<std::string>>();
    add_project_path(*command, *path);
    command->add_option("region", *region, "Name or id of the region")->required();
    command->add_option("frame", *frame, "Frame on which the texture is corrected")
        ->required()
        ->transform(whole_number());
    command
        ->add_option("--pin", *pins,
                     "x,y:x,y in plate pixels: from where the texture is to where it belongs; "
                     "repeatable. Without pins the frame's correction is removed")
        ->type_name("")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->footer(
        "The frame becomes a reference frame; the correction is interpolated between it and its "
        "neighbours.\n"
        "Example:\n  weft region correct shot.weft wall 1024 --pin 120,80:132,75 --pin "
        "400,90:400,90");
    on_run(*command, result, [=]() -> CommandResult {
        SetCorrection edit{{0, *region}, *frame, {}};
        for (const std::string& text : *pins) {
            WEFT_TRY(pin, pin_from(text));
            edit.pins.push_back(pin);
        }
        return region_correct_command(*path, edit);
    });
}

void add_region(CLI::App& app, CommandResult& result) {
    CLI::App* group =
        app.add_subcommand("region", "Add, change, remove or list a project's regions");
    group->require_subcommand(1);
    add_region_add(*group, result);
    add_region_set(*group, result);
    add_region_remove(*group, result);
    add_region_correct(*group, result);
    CLI::App* list = group->add_subcommand("list", "List the regions, lowest layer first");
    const auto path = std::make_shared<std::string>();
    add_project_path(*list, *path);
    list->footer("Example:\n  weft region list shot.weft --json");
    on_run(*list, result, [=] { return region_list_command(*path); });
}

void add_apply(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand("apply", "Apply a file of actions to a project");
    const auto path = std::make_shared<std::string>(), actions = std::make_shared<std::string>();
    const auto dry = std::make_shared<bool>(false);
    add_project_path(*command, *path);
    command
        ->add_option("actions", *actions,
                     "JSON list of actions (docs/FORMATS.md); - for standard input")
        ->required()
        ->type_name("PATH");
    command->add_flag("--dry-run", *dry, "Check the actions and change nothing");
    command->footer(
        "All actions are applied, or none.\n"
        "Example:\n  weft apply shot.weft retake.json");
    const auto library = add_library_flag(*command);
    on_run(*command, result, [=] { return apply_command(*path, *actions, *library, *dry); });
}

void add_info(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand("info", "Show the contents of a project");
    const auto path = std::make_shared<std::string>();
    add_project_path(*command, *path);
    command->footer("Example:\n  weft info shot.weft --json");
    on_run(*command, result, [=] { return info_command(*path); });
}

void add_validate(CLI::App& app, CommandResult& result) {
    CLI::App* command = app.add_subcommand("validate", "Check a project and the files it needs");
    const auto path = std::make_shared<std::string>();
    const auto no_files = std::make_shared<bool>(false);
    add_project_path(*command, *path);
    command->add_flag("--no-files", *no_files, "Check only the document");
    command->footer("Example:\n  weft validate shot.weft");
    on_run(*command, result, [=] { return validate_command(*path, !*no_files); });
}

}  // namespace

void add_project_commands(CLI::App& app, CommandResult& result) {
    add_new(app, result);
    add_region(app, result);
    add_apply(app, result);
    add_info(app, result);
    add_validate(app, result);
}

}  // namespace weft
