#pragma once
// Internal: the vectors that an image–text model computes for a library's samples.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/cancel.h"
#include "engine/core/progress.h"
#include "texture_db/catalogue/index.h"
#include "texture_db/describe/image_text_model.h"

namespace weft {

/// The samples' vectors, one byte per number: 8 MB for 16,000 samples of 512 numbers.
struct SampleEmbeddings {
    int dimensions = 0;
    std::vector<std::int8_t>
        vectors;  ///< samples of the index × dimensions; 0 where none is known.
};

/// A unit vector in bytes: round(127 x).
[[nodiscard]] std::vector<std::int8_t> embedding_bytes(std::span<const float> unit);

/// Reads the stored vectors of a model; samples that were added after it was set have none.
[[nodiscard]] Expected<SampleEmbeddings> load_embeddings(Database& database,
                                                         const SampleIndex& index, int dimensions);

/// How much more similar to the words each sample is than the library's samples usually are, in
/// standard deviations; empty if `words` is empty.
[[nodiscard]] std::vector<float> similarity_to_words(const SampleEmbeddings& embeddings,
                                                     std::span<const float> words);

/// Note: the model's folder.
inline constexpr const char* kModelFolderNote = "image_text_model";
/// Note: the model that computed the vectors.
inline constexpr const char* kModelIdentityNote = "image_text_seen_by";

/// Sets the library's model and encodes the samples that have no vector yet, a batch at a time. A
/// null model with an empty `folder`: none. The caller holds the library's lock.
[[nodiscard]] Status encode_samples(Database& database, const std::string& folder,
                                    ImageTextModel* model, const CancelToken& cancel,
                                    const ProgressFn& progress);

}  // namespace weft
