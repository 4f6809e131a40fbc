#pragma once
#include <string>
#include <vector>

#include "engine/media/sequence_pattern.h"

namespace weft {

/// The files of `frames` that are there, in that order; of a pattern without a frame number its one
/// file, once.
[[nodiscard]] std::vector<std::string> existing_files(const SequencePattern& pattern,
                                                      const std::vector<int>& frames);

}  // namespace weft
