// weft new, region add|set|list, apply, info and validate.

#include <cstdio>

#include "app/cli/region_flags.h"
#include "app/project/edit.h"
#include "app/project/project_file.h"

namespace weft {
namespace {

void add_path(CLI::App& command, std::string& path) {
    command.add_option("project", path, "Project file (.weft)")->required()->type_name("PATH");
}

void add_new(CLI::App& app, int& exit) {
    CLI::App* command = app.add_subcommand("new", "Make a project file");
    const auto path = std::make_shared<std::string>();
    const auto overwrite = std::make_shared<bool>(false);
    add_path(*command, *path);
    const auto flags = std::make_shared<ProjectFlags>(
        *command, ProjectFlags::Which{true, true, true, false, false});
    command->add_flag("--overwrite", *overwrite, "Replace the file if it exists");
    command->footer(
        "Relative paths are kept as written and mean the project file's folder.\n"
        "Example:\n  weft new shot.weft --plate 'frames/####.exr' -o 'out/####.exr' --frames "
        "1001-1048");
    command->callback([=, &exit] {
        Project project;
        const Status status = flags->apply(project);
        exit = status ? new_command(*path, project, *overwrite) : report_error(status.error());
    });
}

void add_region_add(CLI::App& group, int& exit) {
    CLI::App* command = group.add_subcommand("add", "Add a region on top");
    const auto path = std::make_shared<std::string>();
    add_path(*command, *path);
    const auto flags = std::make_shared<ProjectFlags>(
        *command, ProjectFlags::Which{false, false, false, true, true});
    command->footer(
        "Example:\n"
        "  weft region add shot.weft --name wall --matte 'masks/wall.####.png' --texture brick.jpg "
        "--scale 1.5");
    const auto library = add_library_flag(*command);
    command->callback([=, &exit] {
        Region region;
        const Status status = flags->apply(region);
        exit = status ? region_add_command(*path, std::move(region), *library)
                      : report_error(status.error());
    });
}

void add_region_set(CLI::App& group, int& exit) {
    CLI::App* command = group.add_subcommand("set", "Change a region");
    const auto path = std::make_shared<std::string>(), region = std::make_shared<std::string>();
    add_path(*command, *path);
    command->add_option("region", *region, "Name or id of the region")->required();
    const auto flags = std::make_shared<ProjectFlags>(
        *command, ProjectFlags::Which{false, false, false, true, true});
    command->footer(
        "Example:\n  weft region set shot.weft wall --rotate 12 --light-strength 0.7\n"
        "  weft region set shot.weft wall --enabled=false");
    const auto library = add_library_flag(*command);
    command->callback([=, &exit] {
        auto project = load_project(*path);
        if (!project) {
            exit = report_error(project.error());
            return;
        }
        const auto index = find_region(*project, *region);
        if (!index) {
            exit = report_error(index.error());
            return;
        }
        Region changed = *project->regions[*index];
        const Status status = flags->apply(changed);
        exit = status ? region_set_command(*path, *project, *index, changed, *library)
                      : report_error(status.error());
    });
}

// "120,80:132,75": what shows at the first point belongs at the second.
Expected<CorrectionPin> pin_from(const std::string& text) {
    CorrectionPin pin;
    int used = 0;
    const int read = std::sscanf(text.c_str(), "%lf,%lf:%lf,%lf%n", &pin.from.x, &pin.from.y,
                                 &pin.to.x, &pin.to.y, &used);
    if (read != 4 || used != static_cast<int>(text.size()))
        return fail(ErrorCode::kUsage,
                    "The pin '" + text + "' is not of the form x,y:x,y (plate pixels: from, to).");
    return pin;
}

void add_region_correct(CLI::App& group, int& exit) {
    CLI::App* command = group.add_subcommand("correct", "Put a texture back in place on a frame");
    const auto path = std::make_shared<std::string>(), region = std::make_shared<std::string>();
    const auto frame = std::make_shared<int>(0);
    const auto pins = std::make_shared<std::vector<std::string>>();
    add_path(*command, *path);
    command->add_option("region", *region, "Name or id of the region")->required();
    command->add_option("frame", *frame, "Frame on which the texture is put right")->required();
    command
        ->add_option("--pin", *pins,
                     "x,y:x,y in plate pixels: what shows at the first point belongs at the "
                     "second; repeatable. Without pins the frame's correction is removed")
        ->type_name("")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->footer(
        "The frame becomes a reference frame of its own; between it and its neighbours the "
        "difference is spread.\n"
        "Example:\n  weft region correct shot.weft wall 1024 --pin 120,80:132,75 --pin "
        "400,90:400,90");
    command->callback([=, &exit] {
        SetCorrection edit{{0, *region}, *frame, {}};
        for (const std::string& text : *pins) {
            const auto pin = pin_from(text);
            if (!pin) {
                exit = report_error(pin.error());
                return;
            }
            edit.pins.push_back(*pin);
        }
        exit = region_correct_command(*path, edit);
    });
}

void add_region(CLI::App& app, int& exit) {
    CLI::App* group = app.add_subcommand("region", "Add, change or list a project's regions");
    group->require_subcommand(1);
    add_region_add(*group, exit);
    add_region_set(*group, exit);
    add_region_correct(*group, exit);
    CLI::App* list = group->add_subcommand("list", "List the regions, lowest layer first");
    const auto path = std::make_shared<std::string>();
    const auto json = std::make_shared<bool>(false);
    add_path(*list, *path);
    list->add_flag("--json", *json, "As JSON");
    list->footer("Example:\n  weft region list shot.weft --json");
    list->callback([=, &exit] { exit = region_list_command(*path, *json); });
}

void add_apply(CLI::App& app, int& exit) {
    CLI::App* command = app.add_subcommand("apply", "Apply a file of actions to a project");
    const auto path = std::make_shared<std::string>(), actions = std::make_shared<std::string>();
    const auto dry = std::make_shared<bool>(false);
    add_path(*command, *path);
    command->add_option("actions", *actions, "JSON list of actions (docs/FORMATS.md)")
        ->required()
        ->type_name("PATH");
    command->add_flag("--dry-run", *dry, "Check the actions and change nothing");
    command->footer(
        "All actions are applied, or none.\n"
        "Example:\n  weft apply shot.weft retake.json");
    const auto library = add_library_flag(*command);
    command->callback([=, &exit] { exit = apply_command(*path, *actions, *library, *dry); });
}

void add_info(CLI::App& app, int& exit) {
    CLI::App* command = app.add_subcommand("info", "Show what a project holds");
    const auto path = std::make_shared<std::string>();
    const auto json = std::make_shared<bool>(false);
    add_path(*command, *path);
    command->add_flag("--json", *json, "As JSON");
    command->footer("Example:\n  weft info shot.weft --json");
    command->callback([=, &exit] { exit = info_command(*path, *json); });
}

void add_validate(CLI::App& app, int& exit) {
    CLI::App* command = app.add_subcommand("validate", "Check a project and the files it needs");
    const auto path = std::make_shared<std::string>();
    const auto no_files = std::make_shared<bool>(false);
    add_path(*command, *path);
    command->add_flag("--no-files", *no_files, "Check the document alone");
    command->footer("Example:\n  weft validate shot.weft");
    command->callback([=, &exit] { exit = validate_command(*path, !*no_files); });
}

}  // namespace

void add_project_commands(CLI::App& app, int& exit) {
    add_new(app, exit);
    add_region(app, exit);
    add_apply(app, exit);
    add_info(app, exit);
    add_validate(app, exit);
}

}  // namespace weft
