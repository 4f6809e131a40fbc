#pragma once
// Internal to the command table: an entry, and the entries of its first part.

#include <functional>
#include <vector>

#include "ui/base/commands.h"

namespace weft {

[[nodiscard]] Command command(const char* id, const char* category, const char* name,
                              const char* icon, const char* key, std::function<void(Ctx&)> run,
                              std::function<bool(const Ctx&)> enabled = {},
                              std::function<bool(const Ctx&)> checked = {});

/// Whether a project is open.
[[nodiscard]] bool is_open(const Ctx& c);

void add_file_commands(std::vector<Command>& out);

}  // namespace weft
