#pragma once

#include "app/cli/edit_command.h"

namespace weft {

/// Runs one subcommand and returns the process's exit code (docs/CLI.md). `edit` opens the editor.
int run_cli(int argc, char** argv, const EditCommand& edit);

}  // namespace weft
