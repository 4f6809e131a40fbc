#include "app/cli/cli.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "app/cli/region_flags.h"
#include "app/cli/texture_commands.h"
#include "app/session/render_job.h"
#include "app/session/report.h"

namespace weft {
namespace {

// "weft region add" where that is what was asked for, else "weft".
std::string command_of(const CLI::App& app) {
    std::string name = "weft";
    for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
        at = at->get_subcommands().front();
        name += " " + at->get_name();
    }
    return name;
}

bool has_command(const CLI::App& app, const std::string& name) {
    return !app.get_subcommands([&](const CLI::App* command) { return command->check_name(name); })
                .empty();
}

// One line for what CLI11 found wrong with the arguments.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error, int argc,
                          char** argv) {
    std::string what = error.what();
    const std::string first = argc > 1 ? argv[1] : "";
    if (argc < 2) {
        what = "No command was given";
    } else if (first[0] != '-' && !has_command(app, first)) {
        what = "There is no command '" + first + "'";
    }
    std::replace(what.begin(), what.end(), '\n', ' ');
    return "weft: " + what + ". Run '" + command_of(app) + " --help'.\n";
}

// CLI11 answers help and version itself; everything else is wrong usage.
int parse(CLI::App& app, int argc, char** argv, int& exit) {
    try {
        app.parse(argc, argv);
        return exit;
    } catch (const CLI::Success& done) {
        return app.exit(done);
    } catch (const CLI::ParseError& error) {
        print(stderr, usage_message(app, error, argc, argv));
        return exit_code(ErrorCode::kUsage);
    }
}

}  // namespace

int run_cli(int argc, char** argv, const EditCommand& edit) {
    // A write beyond the limit on a file's size then fails as on a full disk, with our message.
    std::signal(SIGXFSZ, SIG_IGN);
    keep_libraries_steady();
    CLI::App app("Weft replaces textures in animation.", "weft");
    app.set_version_flag("--version", [] { return version_text(); });
    app.require_subcommand(1);
    app.get_formatter()->column_width(34);
    app.footer(
        "Exit codes: 0 ok, 1 render failed, 2 usage, 3 project or input unreadable, 4 missing "
        "frames,\n"
        "5 backend unavailable, 6 out of disk or memory, 7 refused by policy, 8 verification "
        "differs,\n"
        "130 interrupted, 143 terminated. Each command has its own --help with examples.");
    int exit = 0;
    add_render_commands(app, exit);
    add_project_commands(app, exit);
    add_synth_commands(app, exit);
    add_tool_commands(app, exit);
    add_edit_command(app, exit, edit);
    add_texture_commands(app, exit);
    add_study_command(app, exit);
    add_studio_commands(app, exit);
    try {
        const int code = parse(app, argc, argv, exit);
        if (code == 0 && std::ferror(stdout)) {
            return report_error(
                {ErrorCode::kNoSpace,
                 "What was to be printed could not be written. Free disk space, or send the "
                 "standard output elsewhere.",
                 {}});
        }
        return code;
    } catch (const std::bad_alloc&) {
        return report_error(
            {ErrorCode::kNoSpace, "Out of memory. Use fewer --threads or smaller plates.", {}});
    } catch (const std::exception& error) {
        return report_error(
            {ErrorCode::kRenderFailed, std::string("Unexpected failure: ") + error.what(), {}});
    }
}

}  // namespace weft
