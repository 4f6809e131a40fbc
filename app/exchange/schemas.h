#pragma once
#include <string>

#include "engine/core/error.h"

namespace weft {

/// The JSON Schema (2020-12) of "project", "actions", "report" or "error"; docs/schemas holds the
/// same. Errors: Usage for another name.
[[nodiscard]] Expected<std::string> json_schema(const std::string& name);

}  // namespace weft
