#pragma once
// The table of all commands: names, keys, actions and conditions.

#include <vector>

#include "ui/base/commands.h"

namespace weft {

/// All commands in menu order, with default keys.
[[nodiscard]] std::vector<Command> all_commands();

}  // namespace weft
