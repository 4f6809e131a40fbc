#include "app/project/region_names.h"

#include <fmt/format.h>

namespace weft {

Status check_name_is_free(const Project& project, RegionId id, const std::string& name) {
    if (name.empty()) return {};
    for (const Leaf<Region>& other : project.regions)
        if (other->id != id && other->name == name)
            return fail(ErrorCode::kUsage,
                        fmt::format("There is a region '{}' already (id {}).", name, other->id),
                        "Choose another name");
    return {};
}

std::string free_region_name(const Project& project, const std::string& wanted) {
    std::string name = wanted;
    for (int number = 2; !check_name_is_free(project, 0, name); ++number)
        name = fmt::format("{} {}", wanted, number);
    return name;
}

}  // namespace weft
