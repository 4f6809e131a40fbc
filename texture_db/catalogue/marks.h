#pragma once
// The artist's own data in a library's file: favourites, ratings, recently used textures,
// collections, saved searches. Ids are full; the caller holds the library's lock.

#include <string>
#include <vector>

#include "engine/core/error.h"
#include "texture_db/catalogue/query.h"

namespace weft {

class Database;

struct SavedSearch {
    std::string name;
    std::string text;  ///< The words; the other conditions are stored as JSON.
    SearchQuery query;
};

[[nodiscard]] Status set_favourite(Database& database, const std::string& id, bool favourite);
[[nodiscard]] Status set_rating(Database& database, const std::string& id, int rating);
[[nodiscard]] Status set_material(Database& database, const std::string& id,
                                  const std::string& material);
[[nodiscard]] Status set_tags(Database& database, const std::string& id,
                              const std::vector<std::string>& tags);
[[nodiscard]] Status mark_used(Database& database, const std::string& id);
[[nodiscard]] Expected<std::vector<std::string>> recent(Database& database, int count);
[[nodiscard]] Expected<std::vector<FacetCount>> collections(Database& database);
[[nodiscard]] Status add_to_collection(Database& database, const std::string& name,
                                       const std::string& id);
[[nodiscard]] Status remove_from_collection(Database& database, const std::string& name,
                                            const std::string& id);
[[nodiscard]] Status delete_collection(Database& database, const std::string& name);
[[nodiscard]] Expected<std::vector<SavedSearch>> saved_searches(Database& database);
[[nodiscard]] Status save_search(Database& database, const std::string& name,
                                 const SearchQuery& search);
[[nodiscard]] Status delete_saved_search(Database& database, const std::string& name);

}  // namespace weft
