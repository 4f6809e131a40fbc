#pragma once
// The region that the editor adds.

#include <string>

#include "app/project/region_names.h"

namespace weft {

/// With a free name and a colour of its own.
[[nodiscard]] inline Region next_region(const Project& project) {
    constexpr std::size_t kColors = 7;
    Region out;
    out.name = free_region_name(project, "Region " + std::to_string(project.next_region_id));
    out.color = static_cast<int>(project.regions.size() % kColors);
    return out;
}

}  // namespace weft
