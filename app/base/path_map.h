#pragma once
#include <string>
#include <vector>

#include "app/project/project.h"

namespace weft {

/// A root folder with another path on this machine: "/mnt/proj=/Volumes/proj".
struct RootMap {
    std::string from, to;
};
/// Errors: Usage when there is no "=", or nothing before it.
[[nodiscard]] Expected<RootMap> parse_root_map(const std::string& text);

/// Moves every path of the project below a root to the other root. The first map that matches wins.
/// Roots match whole folder names: /proj does not match /project.
[[nodiscard]] Project with_mapped_roots(const Project& project, const std::vector<RootMap>& maps);

}  // namespace weft
