#pragma once
// Frames that an earlier run left, and which of them need not be made again.

#include <vector>

#include "app/session/render_job.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

/// Those of `frames` that are kept, ascending. `recipe`: the metadata that the new frames will
/// carry. Errors: Usage when frames exist and are to be refused, or when they were rendered with
/// the same settings on another backend, whose pixels may differ.
[[nodiscard]] Expected<std::vector<int>> frames_to_keep(
    const SequencePattern& pattern, const std::vector<int>& frames, Size size,
    ExistingFrames existing, const std::vector<std::pair<std::string, std::string>>& recipe);

}  // namespace weft
