#pragma once
// Queries to a texture library, and their results.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/geometry.h"
#include "texture_db/describe/attributes.h"

namespace weft {

enum class TextureOrigin { kProcedural, kPackage, kFile };
[[nodiscard]] const char* name_of(TextureOrigin origin);  ///< "procedural", "package", "file".

/// Everything known about one sample but its pixels.
struct TextureInfo {
    std::string id;        ///< 32 hexadecimal digits: the hash of the 96×96 pixels.
    std::string name;      ///< "wall bricks 005, tile 12".
    std::string material;  ///< One word of the vocabulary: "brick".
    std::string category;  ///< The folder it came from, or empty.
    std::vector<std::string> tags;
    MeasuredTexture measured;
    TextureOrigin origin = TextureOrigin::kProcedural;
    std::string package;  ///< Debian package, or empty.
    std::string source;   ///< Path inside the package, path of the file, or generator and seed.
    std::string author;
    std::string licence;  ///< As the source writes it: "GPL-2+", "CC-BY-SA-3.0", "unknown".
    Size original_size;   ///< Of the larger picture that it can be magnified from.
    bool original_in_file = false;  ///< In the library; else by reference to the source.
    float synthesisability = 0;     ///< 0 … 1: how well a plane grown from it holds together.
    bool favourite = false;
    int rating = 0;  ///< 0 none, 1 … 5.
};

enum class TextureSort {
    kRelevance,
    kName,
    kMaterial,
    kNewest,
    kRating,
    kBrightness,
    kHue,
    kScale
};

/// All given conditions hold together; a list is "any of".
struct SearchQuery {
    std::string text;  ///< "rough grey stone"; empty: everything.
    std::vector<std::string> materials;
    std::vector<TextureOrigin> origins;
    std::vector<std::string> packages;
    std::vector<std::string> licences;           ///< Exactly these.
    std::vector<std::string> excluded_licences;  ///< Licence names or families ("GPL", "CC-BY-SA").
    std::vector<std::string> categories;
    std::string collection;  ///< Name of a collection, or empty.
    bool favourites_only = false;
    int min_rating = 0;
    TextureSort sort = TextureSort::kRelevance;
    bool descending = false;  ///< Reverses the order.
    int offset = 0;
    int limit = 60;  ///< Hits of one page; 0: none, counts and facets only.
    bool facets = true;
};

struct SearchHit {
    std::string id;
    std::string name;
    std::string material;
    float score = 0;                   ///< 0 … 1.
    std::vector<std::string> reasons;  ///< "material: stone (grey rock)", "looks rough".
};

struct FacetCount {
    std::string value;
    int count = 0;
};

struct SearchResult {
    std::vector<SearchHit> hits;  ///< [offset, offset + limit) of all.
    int total = 0;
    /// Counts over all hits, most frequent first (ties by name).
    std::vector<FacetCount> materials, origins, packages, licences, categories, colours;
    std::vector<std::string> understood;  ///< How each word was read: "timbr → timber → wood".
    std::vector<std::string> ignored;     ///< Words that match nothing in the library.
    /// Where no texture matches every word and the nearest are the hits: what the best lacks.
    std::vector<std::string> missing;
    double seconds = 0;
};

}  // namespace weft
