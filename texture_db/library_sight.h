#pragma once
// Internal: what an image–text model makes of a library's samples.

#include <cstdint>
#include <span>
#include <vector>

#include "texture_db/image_text_model.h"
#include "texture_db/index.h"

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

}  // namespace weft
