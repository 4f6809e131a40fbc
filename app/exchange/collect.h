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

/// Copies everything that a project needs into `folder`: its plates, mattes, passes and textures
/// (those of a library with their pixels and credits) below files/, and a project file of the name
/// `name` whose paths are relative. Its outputs go below out/. `project` has its paths resolved.
/// Nothing is overwritten: Usage when a file is there already. Errors: those of reading
/// and writing; MissingFrames when an input is not there.
[[nodiscard]] Expected<Collected> collect_project(const Project& project, const std::string& name,
                                                  const std::string& folder,
                                                  const std::string& library,
                                                  const WriteLimits& limits,
                                                  const CancelToken& cancel,
                                                  const ProgressFn& progress);

}  // namespace weft
