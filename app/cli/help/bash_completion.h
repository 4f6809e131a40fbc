#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace weft {

/// Returns the completion of the whole command line for bash: a script that holds every command and
/// option, since asking the program at each press of the key would take a second. `app` comes from
/// add_commands().
[[nodiscard]] std::string bash_completion(const CLI::App& app);

}  // namespace weft
