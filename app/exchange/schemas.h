#pragma once
#include <string>

#include "engine/core/error.h"

namespace weft {

/// Returns the JSON Schema (2020-12) of "project", "actions", "report", "motion" or "error";
/// docs/schemas holds the same text. Errors: Usage for another name.
[[nodiscard]] Expected<std::string> json_schema(const std::string& name);

}  // namespace weft
