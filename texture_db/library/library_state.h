#pragma once
// Internal: what a TextureLibrary holds.

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "texture_db/catalogue/database.h"
#include "texture_db/catalogue/index.h"
#include "texture_db/catalogue/rows.h"
#include "texture_db/describe/descriptor_model.h"
#include "texture_db/library/library.h"
#include "texture_db/search/sample_sight.h"
#include "texture_db/search/search.h"
#include "texture_db/search/word_reader.h"

namespace weft {

struct TextureLibrary::State {
    std::string path;
    bool read_only = false;
    std::mutex mutex;  // guards everything below
    std::unique_ptr<Database> database;
    // Loaded when first needed, and anew when the file has changed since.
    std::optional<SampleIndex> index;
    std::optional<DescriptorModel> model;
    std::optional<WordReader> words;
    std::int64_t loaded_data_version = -1, loaded_changes = -1;

    // The image–text model that the library names, and what it made of the samples.
    std::optional<ImageTextModel> sight_model;
    std::optional<SampleSight> sight;
    std::string sight_fault;  // why there is none though one is named
    bool sight_tried = false;
    std::int64_t sight_changes = -1;

    /// Opens the model that the library names and reads what it saw, unless that is done. Call
    /// after refresh(), with the mutex held. A model that cannot be used is no error: `sight_fault`
    /// says why.
    [[nodiscard]] Expected<LibrarySight> open_sight();
    /// Makes index, model and words current. Call with the mutex held.
    [[nodiscard]] Status refresh();

  private:
    [[nodiscard]] Status read_sight();
};

}  // namespace weft
