#pragma once
#include <optional>
#include <string>

#include "app/project/project.h"

namespace weft {

/// The version in a path: the digits of its last separate "v###" (shot_v003.####.exr: 3).
[[nodiscard]] std::optional<int> version_in(const std::string& path);

/// Returns the project with its outputs (images, movie, layers) at the next version after the
/// highest on disk; unchanged if none exists. Errors: Usage when the image path has no v###.
[[nodiscard]] Expected<Project> version_up(const Project& project);

}  // namespace weft
