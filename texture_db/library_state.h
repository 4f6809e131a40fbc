#pragma once
// Internal: what a TextureLibrary holds.

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "texture_db/database.h"
#include "texture_db/descriptor_model.h"
#include "texture_db/index.h"
#include "texture_db/library.h"
#include "texture_db/library_sight.h"
#include "texture_db/word_reader.h"

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
    [[nodiscard]] Status open_sight();
    /// Makes index, model and words current. Call with the mutex held.
    [[nodiscard]] Status refresh();
    /// The full id of an id or a prefix of it.
    [[nodiscard]] Expected<std::string> full_id(const std::string& id);
    [[nodiscard]] Status count_change();
};

/// What changes about a library when samples are added: computed outside of its lock.
struct PreparedTexture {
    std::string id;
    std::vector<std::byte> png;
    MeasuredTexture measured;
    std::vector<float> features;
    float synthesis = 0;
};
/// A larger picture, encoded once for all samples from it.
struct PreparedPicture {
    Size size;
    std::string hash;
    std::vector<std::byte> bytes;
};
/// A sample's pixels as they are stored.
struct StoredPixels {
    std::int64_t key = 0;
    std::vector<std::byte> png;
};
/// The next `count` samples behind key `after`, by key; `from_where`: "FROM pixels p … WHERE …".
[[nodiscard]] Expected<std::vector<StoredPixels>> pixels_behind(Database& database,
                                                                const std::string& from_where,
                                                                std::int64_t after,
                                                                std::size_t count);
/// A note's text; empty for one that is not there.
[[nodiscard]] Expected<std::string> text_note(Database& database, const std::string& key);
[[nodiscard]] Status set_text_note(Database& database, const std::string& key,
                                   const std::string& value);
[[nodiscard]] Status store_descriptor(Database& database, std::int64_t key,
                                      std::span<const float> descriptor);
[[nodiscard]] PreparedTexture prepare_texture(const NewTexture& texture);

}  // namespace weft
