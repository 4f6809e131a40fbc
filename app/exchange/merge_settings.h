#pragma once
// The settings of a region or a project as JSON, merged one by one. Internal to the merge.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/exchange/merge_project.h"

namespace weft {

/// What is changed to what in one object of a project file: a region, or the project without its
/// regions. Appends to `conflicts`, under the region's name.
[[nodiscard]] nlohmann::json merged_settings(const nlohmann::json& base, const nlohmann::json& mine,
                                             const nlohmann::json& theirs, MergeSide wins,
                                             const std::string& region,
                                             std::vector<MergeConflict>& conflicts);

}  // namespace weft
