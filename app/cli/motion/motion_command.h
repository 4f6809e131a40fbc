#pragma once
#include "app/cli/answer.h"
#include "app/cli/console.h"
#include "app/motion_export/motion_job.h"

namespace weft {

/// `weft motion`: the project has its paths resolved.
CommandResult motion_command(const MotionJobSpec& spec, ProgressStyle progress);

}  // namespace weft
