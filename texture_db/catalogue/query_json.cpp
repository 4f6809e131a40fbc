#include "texture_db/catalogue/query_json.h"

#include <nlohmann/json.hpp>

namespace weft {

std::string query_to_json(const SearchQuery& q) {
    std::vector<int> origins;
    for (const TextureOrigin origin : q.origins)
        origins.push_back(static_cast<int>(origin));
    return nlohmann::ordered_json{{"text", q.text},
                                  {"materials", q.materials},
                                  {"origins", origins},
                                  {"packages", q.packages},
                                  {"licences", q.licences},
                                  {"excluded_licences", q.excluded_licences},
                                  {"categories", q.categories},
                                  {"collection", q.collection},
                                  {"favourites_only", q.favourites_only},
                                  {"min_rating", q.min_rating},
                                  {"sort", static_cast<int>(q.sort)},
                                  {"descending", q.descending}}
        .dump();
}

Expected<SearchQuery> query_from_json(const std::string& text) {
    try {
        const auto json = nlohmann::json::parse(text);
        SearchQuery q;
        q.text = json.value("text", q.text);
        q.materials = json.value("materials", q.materials);
        for (const int origin : json.value("origins", std::vector<int>{})) {
            if (origin >= 0 && origin <= 2) q.origins.push_back(static_cast<TextureOrigin>(origin));
        }
        q.packages = json.value("packages", q.packages);
        q.licences = json.value("licences", q.licences);
        q.excluded_licences = json.value("excluded_licences", q.excluded_licences);
        q.categories = json.value("categories", q.categories);
        q.collection = json.value("collection", q.collection);
        q.favourites_only = json.value("favourites_only", q.favourites_only);
        q.min_rating = json.value("min_rating", q.min_rating);
        const int sort = json.value("sort", 0);
        if (sort >= 0 && sort <= static_cast<int>(TextureSort::kScale))
            q.sort = static_cast<TextureSort>(sort);
        q.descending = json.value("descending", q.descending);
        return q;
    } catch (const nlohmann::json::exception&) {
        return fail(ErrorCode::kUnreadable, "It is damaged.", "Delete it and save it again.");
    }
}

}  // namespace weft
