#pragma once
#include "app/cli/answer.h"
#include "app/cli/commands.h"
#include "app/project/project.h"

namespace weft {

/// `weft form`: the project has its paths resolved.
CommandResult form_command(const Project& project, const RunOptions& run);

}  // namespace weft
