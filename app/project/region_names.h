#pragma once
// Commands and actions find a region by its name, so edits let no two share one. Documents that
// were written elsewhere may have such regions; they still open.

#include <string>

#include "app/project/project.h"
#include "engine/core/error.h"

namespace weft {

/// Errors: Usage when another region than that of `id` has this name. Empty names are allowed.
[[nodiscard]] Status check_name_is_free(const Project& project, RegionId id,
                                        const std::string& name);

/// `wanted`, or "wanted 2", "wanted 3", …: the first that no region is called.
[[nodiscard]] std::string free_region_name(const Project& project, const std::string& wanted);

}  // namespace weft
