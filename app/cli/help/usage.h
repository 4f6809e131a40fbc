#pragma once
// Usage errors in Weft's own words.

#include <CLI/CLI.hpp>
#include <string>
#include <utility>

#include "engine/core/error.h"

namespace weft {

/// Thrown by an option's callback: CLI11's own error holds one text, without the remedy.
class RefusedValue : public CLI::ValidationError {
  public:
    RefusedValue(const std::string& name, weft::Error why)
        : ValidationError(name, why.sentence()), option(name), error(std::move(why)) {}
    std::string option;
    weft::Error error;
};

/// Converts a parse error of CLI11 to an error of kind Usage. `app` parsed the `argc` words.
[[nodiscard]] Error usage_error(const CLI::App& app, const CLI::ParseError& error, int argc);

/// Sets Weft's format of --help on the app and all subcommands.
void use_our_help(CLI::App& app);

/// The command that was given, such as "weft region add"; otherwise "weft".
[[nodiscard]] std::string command_of(const CLI::App& app);

}  // namespace weft
