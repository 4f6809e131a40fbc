#pragma once

namespace weft {

/// Runs one subcommand and returns the process's exit code (docs/CLI.md).
int run_cli(int argc, char** argv);

}  // namespace weft
