#pragma once
// Internal: a search as JSON, for saved searches.

#include <string>

#include "engine/core/error.h"
#include "texture_db/catalogue/query.h"

namespace weft {

[[nodiscard]] std::string query_to_json(const SearchQuery& query);
/// Unknown keys are left alone; missing ones keep their defaults. Errors: Unreadable.
[[nodiscard]] Expected<SearchQuery> query_from_json(const std::string& text);

}  // namespace weft
