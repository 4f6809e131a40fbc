#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace weft {

/// Returns the manual page of the whole command line in troff: every command with every option.
/// `app` comes from add_commands().
[[nodiscard]] std::string man_page(const CLI::App& app);

}  // namespace weft
