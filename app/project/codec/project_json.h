#pragma once
// The project file (.weft): versioned JSON. Unknown keys of a newer minor version survive loading
// and saving at every level. Older versions are upgraded on reading; newer ones are refused. Equal
// projects give equal bytes on every machine.

#include <string>
#include <string_view>

#include "app/project/project.h"
#include "engine/core/error.h"

namespace weft {

inline constexpr std::string_view kProjectSchemaName = "weft.project";
inline constexpr int kProjectSchemaVersion = 6;

/// Reads a project from JSON text. Hostile input (wrong types, numbers out of range, deep nesting,
/// repeated keys or ids, 100 MB) gives an error, never a crash. Errors: Unreadable; the message
/// begins with the place ("regions[0].placement.scale: …"). Thread-safe.
[[nodiscard]] Expected<Project> project_from_json(std::string_view text);

/// Errors: Usage when a name or path is not UTF-8. Thread-safe.
[[nodiscard]] Expected<std::string> project_to_json(const Project& project);

/// Reads a grid warp as a project file has it under placement.warp; without check_grid_warp().
/// Errors: Unreadable with the place. Thread-safe.
[[nodiscard]] Expected<GridWarp> grid_warp_from_json(std::string_view text);

}  // namespace weft
