#pragma once
// Looks: what a region's surface is given (textures, placement, synthesis, time, light, finish),
// without the shot that it was made in.

#include <string>

#include "app/project/project.h"
#include "engine/media/write_rule.h"

namespace weft {

/// Writes the look of the project's regions, or of the one named `region`. `project` has its paths
/// resolved; in the file they are relative to its folder. Errors: Usage for an unknown region;
/// those of writing.
[[nodiscard]] Status save_look(const std::string& path, const Project& project,
                               const std::string& region, const WriteRule& rule);

/// The project with the look put on its regions: a look of one region on the region named `region`
/// (or the only one), one of several on the regions of the same names. Mattes, motion, references
/// and the shot's own passes stay. `folder`: the project file's, against which paths below it
/// become relative. Errors: Unreadable (the file), Usage when no region fits.
[[nodiscard]] Expected<Project> apply_look(const std::string& path, const Project& project,
                                           const std::string& folder, const std::string& region);

}  // namespace weft
