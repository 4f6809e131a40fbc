#pragma once
// Looks: the textures, placement, synthesis, light, temporal and finish settings of regions,
// without their shot.

#include <string>

#include "app/project/project.h"
#include "engine/media/write_rule.h"

namespace weft {

/// Writes the look of the project's regions, or of the region `region` only. `project` has resolved
/// paths; the file stores them relative to its own folder. Errors: Usage for an unknown region;
/// those of writing.
[[nodiscard]] Status save_look(const std::string& path, const Project& project,
                               const std::string& region, const WriteRule& rule);

/// Applies a look to the project's regions: a look of one region to the region `region` (or the
/// only one), a look of several to the regions of the same names. Mattes, motion, references and
/// the shot's own passes are unchanged. `folder`: the project file's folder; paths below it become
/// relative. Errors: Unreadable (the file), Usage when no region matches.
[[nodiscard]] Expected<Project> apply_look(const std::string& path, const Project& project,
                                           const std::string& folder, const std::string& region);

}  // namespace weft
