#include "app/cli/command_line.h"

#include "app/cli/help/bash_completion.h"
#include "app/cli/help/man_page.h"
#include "app/cli/help/usage.h"

namespace weft {
namespace {

// Added to every command. run_cli() reads it from the arguments.
void add_json_flag(CLI::App& app) {
    app.add_flag_function(
        "--json", [](std::int64_t) {},
        "Print one JSON object on stdout, errors too; progress goes to stderr");
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        add_json_flag(*command);
}

// A text made from the whole command line. For packagers only, so hidden in --help.
struct Page {
    const char* command;
    const char* description;
    const char* json_key;
    std::string (*text)(const CLI::App&);
};

void add_page(CLI::App& app, CommandResult& result, const Page& page) {
    CLI::App* command = app.add_subcommand(page.command, page.description);
    command->group("");
    on_run(*command, result, [&app, page] {
        Answer answer;
        answer.text = page.text(app);
        answer.json[page.json_key] = answer.text;
        return answer;
    });
}

}  // namespace

void add_commands(CLI::App& app, CommandResult& result, const EditCommand& edit) {
    app.name("weft");
    app.description("Weft replaces textures in animation.");
    CLI::Option* version = app.set_version_flag("--version", [] { return std::string("weft"); });
    version->description("Print the version and the backends");
    app.add_flag_function(
           "--licences,--licenses", [](std::int64_t) {},
           "With --version: also the libraries and their licences")
        ->needs(version);
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 ok, 1 render failed, 2 usage, 3 project or input unreadable, 4 missing "
        "frames,\n"
        "5 backend unavailable, 6 out of disk or memory, 7 refused by policy, 8 verification "
        "differs,\n"
        "130 interrupted, 143 terminated. Each command has its own --help with examples.");
    add_render_commands(app, result);
    add_form_command(app, result);
    add_motion_command(app, result);
    add_flatten_command(app, result);
    add_project_commands(app, result);
    add_synth_commands(app, result);
    add_tool_commands(app, result);
    add_edit_command(app, result, edit);
    add_texture_commands(app, result);
    add_study_command(app, result);
    add_studio_commands(app, result);
    add_trust_command(app, result);
    add_page(app, result, {"man", "Print the manual page", "man_page", man_page});
    add_page(app, result,
             {"completion", "Print the completion for bash", "bash_completion", bash_completion});
    add_json_flag(app);
    use_our_help(app);
}

}  // namespace weft
