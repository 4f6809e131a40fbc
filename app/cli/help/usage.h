#pragma once
// What is wrong with a command line, in our own words.

#include <CLI/CLI.hpp>

#include "engine/core/error.h"

namespace weft {

/// The error of kind Usage for what CLI11 refused among `argc` words. `app` is the one that parsed
/// them.
[[nodiscard]] Error usage_error(const CLI::App& app, const CLI::ParseError& error, int argc);

/// Gives the app and all its subcommands our form of --help.
void use_our_help(CLI::App& app);

/// "weft region add" where that is what was asked for, else "weft".
[[nodiscard]] std::string command_of(const CLI::App& app);

}  // namespace weft
