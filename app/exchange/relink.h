#pragma once
// Inputs of a project that are no longer where it says, and where they are now.

#include <string>
#include <vector>

#include "app/project/project.h"
#include "engine/core/cancel.h"

namespace weft {

/// The inputs of `project` (absolute paths) that are missing: plate, mattes, textures, passes and
/// tracks, each once, in the project's order. Textures named by their library id are not checked.
[[nodiscard]] std::vector<std::string> missing_inputs(const Project& project);

struct Relinked {
    Project project;                   ///< With the paths of what was found.
    std::vector<std::string> found;    ///< Paths that were replaced.
    std::vector<std::string> missing;  ///< Paths that are still missing.
};

/// Looks for the missing inputs of `project` (absolute paths) by their names in `folder` and its
/// subfolders. Of several files of a name the one whose folders agree best with the missing path is
/// taken, then the first by name. Errors: MissingFrames when `folder` is not a folder; cancelled.
[[nodiscard]] Expected<Relinked> relink_inputs(const Project& project, const std::string& folder,
                                               const CancelToken& cancel);

}  // namespace weft
