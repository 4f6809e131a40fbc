#pragma once
// Internal: search by words and conditions over a library's samples (docs/TEXTURES.md).

#include <functional>
#include <string>

#include "texture_db/catalogue/index.h"
#include "texture_db/search/sample_embeddings.h"
#include "texture_db/search/word_reader.h"

namespace weft {

/// The image–text model of a library and its vectors of the samples.
struct LibraryEmbeddings {
    ImageTextModel* model = nullptr;            ///< Null: no model, or it cannot be used.
    const SampleEmbeddings* samples = nullptr;  ///< Null: likewise.
    std::string fault;                          ///< Why there are none although a model is set.
};
/// Called only for queries with words, because opening a model takes time.
using OpenEmbeddings = std::function<Expected<LibraryEmbeddings>()>;

/// TextureLibrary::search(). The caller holds the library's lock.
[[nodiscard]] Expected<SearchResult> search_index(Database& database, const SampleIndex& index,
                                                  const WordReader& words,
                                                  const OpenEmbeddings& open_embeddings,
                                                  const SearchQuery& query);

}  // namespace weft
