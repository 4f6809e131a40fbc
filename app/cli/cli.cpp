#include "app/cli/cli.h"

#include <exception>
#include <new>

#include "app/cli/region_flags.h"
#include "app/session/report.h"

namespace weft {
namespace {

// CLI11 answers help and version itself; everything else is wrong usage.
int parse(CLI::App& app, int argc, char** argv, int& exit) {
    try {
        app.parse(argc, argv);
        return exit;
    } catch (const CLI::Success& done) {
        return app.exit(done);
    } catch (const CLI::ParseError& error) {
        print(stderr, std::string("weft: ") + error.what() + "\nRun 'weft --help' or 'weft COMMAND --help'.\n");
        return exit_code(ErrorCode::kUsage);
    }
}

}  // namespace

int run_cli(int argc, char** argv) {
    CLI::App app("Weft replaces textures in animation.", "weft");
    app.set_version_flag("--version", std::string("weft ") + kVersion);
    app.require_subcommand(1);
    app.get_formatter()->column_width(34);
    app.footer(
        "Exit codes: 0 ok, 1 render failed, 2 usage, 3 project or input unreadable, 4 missing frames,\n"
        "5 backend unavailable, 6 out of disk or memory, 7 refused by policy, 8 verification differs,\n"
        "130 interrupted, 143 terminated. Each command has its own --help with examples.");
    int exit = 0;
    add_render_commands(app, exit);
    add_project_commands(app, exit);
    add_tool_commands(app, exit);
    try {
        return parse(app, argc, argv, exit);
    } catch (const std::bad_alloc&) {
        return report_error({ErrorCode::kNoSpace, "Out of memory. Use fewer --threads or smaller plates.", {}});
    } catch (const std::exception& error) {
        return report_error({ErrorCode::kRenderFailed, std::string("Unexpected failure: ") + error.what(), {}});
    }
}

}  // namespace weft
