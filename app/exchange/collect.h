#pragma once
#include <string>

#include "app/exchange/input_files.h"
#include "app/project/project.h"
#include "engine/core/cancel.h"
#include "engine/core/progress.h"

namespace weft {

struct Collected {
    std::string project;  ///< The new project file.
    int files = 0;
    std::int64_t bytes = 0;
};

/// Copies all inputs of a project into `folder`: plates, mattes, passes and textures (those of a
/// library with pixels and credits) go below files/. Writes a project file `name` with relative
/// paths and outputs below out/. `project` has resolved paths. Errors: Usage when a file already
/// exists (nothing is overwritten); MissingFrames when an input is missing; those of reading and
/// writing. After an error or when cancelled, what was copied is removed again. Progress: stage
/// "collect", in files.
[[nodiscard]] Expected<Collected> collect_project(const Project& project, const std::string& name,
                                                  const std::string& folder,
                                                  const std::string& library,
                                                  const WriteLimits& limits,
                                                  const CancelToken& cancel,
                                                  const ProgressFn& progress);

}  // namespace weft
