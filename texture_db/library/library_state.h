#pragma once
// Internal: the state of a TextureLibrary.

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "texture_db/catalogue/database.h"
#include "texture_db/catalogue/index.h"
#include "texture_db/catalogue/rows.h"
#include "texture_db/describe/descriptor_model.h"
#include "texture_db/library/library.h"
#include "texture_db/search/sample_embeddings.h"
#include "texture_db/search/search.h"
#include "texture_db/search/word_reader.h"

namespace weft {

struct TextureLibrary::State {
    std::string path;
    bool read_only = false;
    std::mutex mutex;  // guards everything below
    std::unique_ptr<Database> database;
    // Loaded when first needed, and again after the file has changed.
    std::optional<SampleIndex> index;
    std::optional<DescriptorModel> model;
    std::optional<WordReader> words;
    std::int64_t loaded_data_version = -1, loaded_changes = -1;

    // The library's image–text model, and its vectors of the samples.
    std::optional<ImageTextModel> embedding_model;
    std::optional<SampleEmbeddings> embeddings;
    std::string embedding_fault;  // why there are none although a model is set
    bool embeddings_tried = false;
    std::int64_t embeddings_changes = -1;

    /// Opens the library's model and reads its vectors, unless that is done. Call after refresh(),
    /// with the mutex held. A model that cannot be used is not an error; `embedding_fault` has the
    /// reason.
    [[nodiscard]] Expected<LibraryEmbeddings> open_embeddings();
    /// Makes index, model and words current. Call with the mutex held.
    [[nodiscard]] Status refresh();

  private:
    [[nodiscard]] Status read_embeddings();
};

}  // namespace weft
