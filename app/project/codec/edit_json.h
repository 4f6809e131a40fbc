#pragma once
// Action files: edits as JSON.

#include <string>
#include <string_view>
#include <vector>

#include "app/project/edit.h"
#include "engine/core/error.h"

namespace weft {

/// An action file: a list of edits, or {"schema": "weft.actions/1", "actions": [ … ]}. Each edit is
/// an object named by its "action": {"action": "set_region_parameter", "region": "wall", "key":
/// "placement.scale", "value": 2}. Errors: Unreadable with the place. Unknown keys are errors too,
/// since a misspelt key would be ignored silently.
[[nodiscard]] Expected<std::vector<Edit>> edits_from_json(std::string_view text);
/// Errors: Usage when a text is not UTF-8.
[[nodiscard]] Expected<std::string> edits_to_json(const std::vector<Edit>& edits);

}  // namespace weft
