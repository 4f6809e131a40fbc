#pragma once
// Commands and actions find a region by its name, so edits keep names unique. Documents from other
// programs may have duplicate names; they still open.

#include <string>

#include "app/project/project.h"
#include "engine/core/error.h"

namespace weft {

/// Errors: Usage when a region other than `id` has this name. Empty names are allowed.
[[nodiscard]] Status check_name_is_free(const Project& project, RegionId id,
                                        const std::string& name);

/// Returns `wanted`, or the first free of "wanted 2", "wanted 3", ….
[[nodiscard]] std::string free_region_name(const Project& project, const std::string& wanted);

}  // namespace weft
