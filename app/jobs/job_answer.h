#pragma once
// What a render job says in the end.

#include <optional>
#include <string>
#include <vector>

#include "app/jobs/job_view.h"
#include "app/project/project.h"

namespace weft {

struct JobAnswer {
    int exit_code = 0;
    std::string message, field;  ///< Of an error; settings by key, in braces.
};

/// Nothing: it ended before it could say anything.
[[nodiscard]] std::optional<JobAnswer> read_answer(const std::string& path);

/// Which frame, region and setting an error is about: as the message names them, or, for a frame,
/// by the name of one of its files. `frames`: those of the job.
[[nodiscard]] JobProblem problem_of(const JobAnswer& answer, const Project& project,
                                    const std::vector<int>& frames);

}  // namespace weft
