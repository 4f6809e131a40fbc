#include "app/cli/edit_command.h"

#include <memory>

#include "app/cli/command_line.h"
#include "app/cli/commands.h"
#include "app/cli/option_values.h"
#include "app/cli/region_flags.h"

namespace weft {

void add_edit_command(CLI::App& app, CommandResult& result, const EditCommand& edit) {
    CLI::App* command = app.add_subcommand("edit", "Open the editor");
    const auto given = std::make_shared<EditArguments>();
    given->assets = assets_folder();
    command->add_option("project", given->project, "Project file (.weft), frames or a movie")
        ->type_name("PATH");
    command->add_flag("--demo", given->demo, "Open the demo shot");
    command->add_flag("--paused", given->paused, "Open with the analysis paused");
    command->add_flag("--light", given->light, "The light theme");
    command
        ->add_option("--ui-scale", given->ui_scale, "Size of the interface; default the screen's")
        ->check(number(0.0, 4.0));
    command->add_option("--db", given->library, "Texture library; default: the user's own")
        ->type_name("FILE");
    command->add_option("--script", given->script, "Steps to run without a window (JSON)")
        ->type_name("PATH");
    command
        ->add_option("--screenshot", given->screenshot, "Write a screenshot here, without a window")
        ->type_name("PATH");
    command->add_option("--size", given->size, "Size of the screenshot; default 1600x900")
        ->type_name("WxH");
    command->footer(
        "Examples:\n"
        "  weft edit shot.weft\n"
        "  weft edit 'frames/####.exr'\n"
        "  weft edit --demo --screenshot demo.png --size 1600x900");
    on_run(*command, result, [=]() -> CommandResult {
        WEFT_TRY(code, edit(*given));
        Answer answer;
        answer.exit = code;
        if (!given->screenshot.empty())
            answer.json["screenshot"] = absolute_path(given->screenshot);
        return answer;
    });
}

}  // namespace weft
