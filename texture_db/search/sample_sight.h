#pragma once
// Internal: what an image–text model makes of a library's samples.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/cancel.h"
#include "engine/core/progress.h"
#include "texture_db/catalogue/index.h"
#include "texture_db/describe/image_text_model.h"

namespace weft {

/// The vectors of samples, a byte a number: at 512 numbers 8 MB for 16,000 samples.
struct SampleSight {
    int dimensions = 0;
    std::vector<std::int8_t>
        vectors;  ///< samples of the index × dimensions; 0 where none is known.
};

/// A unit vector by bytes: round(127 x).
[[nodiscard]] std::vector<std::int8_t> bytes_of_sight(std::span<const float> unit);

/// Reads what is stored for a model; samples that came after it was named have none.
[[nodiscard]] Expected<SampleSight> load_sight(Database& database, const SampleIndex& index,
                                               int dimensions);

/// How much more than the library's samples usually do each sample looks like the words, in
/// standard deviations; empty for an empty `words`.
[[nodiscard]] std::vector<float> likeness_to_words(const SampleSight& sight,
                                                   std::span<const float> words);

inline constexpr const char* kSightFolderNote = "image_text_model";      ///< Note: the folder.
inline constexpr const char* kSightIdentityNote = "image_text_seen_by";  ///< Whose vectors it has.

/// Names a model in the file and looks at the samples that it has not seen, a batch at a time;
/// null with an empty `folder`: none. The caller holds the library's lock.
[[nodiscard]] Status look_at_samples(Database& database, const std::string& folder,
                                     ImageTextModel* model, const CancelToken& cancel,
                                     const ProgressFn& progress);

}  // namespace weft
