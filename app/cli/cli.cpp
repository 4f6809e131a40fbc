#include "app/cli/cli.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string_view>

#include "app/cli/command_line.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/help/usage.h"
#include "app/cli/licences.h"
#include "app/cli/setting_flags.h"
#include "app/render/render_job.h"

namespace weft {
namespace {

// Needed before parsing, so that usage errors are JSON objects too.
bool asks_for_json(int argc, char** argv) {
    for (int i = 1; i < argc; ++i)
        if (std::string_view(argv[i]) == "--json") return true;
    return false;
}

// CLI11 handles --help and --version; every other exception is a usage error.
int parse_and_run(int argc, char** argv, const EditCommand& edit) {
    CommandResult result;
    CLI::App app;
    add_commands(app, result, edit);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForVersion&) {
        return conclude(app.count("--licences") > 0 ? licences_answer() : version_answer());
    } catch (const CLI::Success& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        result = tl::unexpected(usage_error(app, error, argc));
    }
    return conclude(result);
}

}  // namespace

int run_cli(int argc, char** argv, const EditCommand& edit) {
    // Ignored, so that writing beyond the file size limit fails like a full disk, with a message.
    std::signal(SIGXFSZ, SIG_IGN);
    make_libraries_deterministic();
    set_json_output(asks_for_json(argc, argv));
    set_setting_namer(names_settings_by_key() ? setting_in_braces : setting_flag);
    try {
        const int code = parse_and_run(argc, argv, edit);
        if (code != 0 || !std::ferror(stdout)) return code;
        return conclude(fail(ErrorCode::kNoSpace, "The standard output cannot be written.",
                             "Free disk space, or redirect it elsewhere."));
    } catch (const std::bad_alloc&) {
        return conclude(
            fail(ErrorCode::kNoSpace, "Out of memory.", "Use fewer --threads or smaller plates."));
    } catch (const std::exception&) {
        // Messages of libraries do not help the user.
        return conclude(fail(ErrorCode::kRenderFailed, "Internal error: an unexpected exception.",
                             "Please report it with the command line."));
    }
}

}  // namespace weft
