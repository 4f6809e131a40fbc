#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace weft {

/// The manual page of the whole command line, in troff: every command with every option. `app` is
/// what add_commands() filled.
[[nodiscard]] std::string man_page(const CLI::App& app);

}  // namespace weft
