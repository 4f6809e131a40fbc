#pragma once
// Action files: edits as JSON.

#include <string>
#include <string_view>
#include <vector>

#include "app/project/edit.h"
#include "engine/core/error.h"

namespace weft {

/// An action file: a list of edits, or {"schema": "weft.actions/1", "actions": [ … ]}. Each is an
/// object whose "action" names it: {"action": "set_region_parameter", "region": "wall", "key":
/// "placement.scale", "value": 2}. Errors: Unreadable with the place; an unknown key of an action
/// is an error too, because a slip there would silently do something else.
[[nodiscard]] Expected<std::vector<Edit>> edits_from_json(std::string_view text);
/// Errors: Usage when a text is not UTF-8.
[[nodiscard]] Expected<std::string> edits_to_json(const std::vector<Edit>& edits);

}  // namespace weft
