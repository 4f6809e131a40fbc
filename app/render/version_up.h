#pragma once
#include <optional>
#include <string>

#include "app/project/project.h"

namespace weft {

/// The version in a path: the digits of its last "v###" that stands alone (shot_v003.####.exr: 3).
[[nodiscard]] std::optional<int> version_in(const std::string& path);

/// The project with its outputs (images, movie, layers) at the version above the highest that is
/// on the disk; its own where nothing is there yet. Errors: Usage where the image path has no v###.
[[nodiscard]] Expected<Project> version_up(const Project& project);

}  // namespace weft
