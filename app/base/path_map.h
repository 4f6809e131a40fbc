#pragma once
#include <string>
#include <vector>

#include "app/project/project.h"

namespace weft {

/// A root that has another name on this machine: "/mnt/proj=/Volumes/proj".
struct RootMap {
    std::string from, to;
};
/// Errors: Usage when there is no "=", or nothing in front of it.
[[nodiscard]] Expected<RootMap> parse_root_map(const std::string& text);

/// Every path of the project that lies below a root, below the other one; the first map that fits
/// counts. A root ends at a slash: /proj does not fit /project.
[[nodiscard]] Project with_mapped_roots(const Project& project, const std::vector<RootMap>& maps);

}  // namespace weft
