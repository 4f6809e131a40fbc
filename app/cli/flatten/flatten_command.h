#pragma once
#include "app/cli/answer.h"
#include "app/cli/console.h"
#include "app/flatten/flatten_job.h"

namespace weft {

/// `weft flatten -o`: the project has its paths resolved.
CommandResult flatten_command(const FlattenSpec& spec, ProgressStyle progress);

/// `weft flatten --back`: puts the painted picture `picture` into the project file.
CommandResult flatten_back_command(const std::string& project, const std::string& region,
                                   const std::string& picture);

}  // namespace weft
