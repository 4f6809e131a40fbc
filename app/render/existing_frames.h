#pragma once
// Frames of an earlier run, and which of them can be kept.

#include <vector>

#include "app/render/render_job.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

/// Those of `frames` that are kept, ascending. `recipe`: the metadata that the new frames will
/// carry. Errors: Usage when frames exist and are to be refused; when one that would be replaced is
/// none of Weft's, other than with kOverwrite; and when they were rendered with the same settings
/// on another backend, whose pixels may differ.
[[nodiscard]] Expected<std::vector<int>> frames_to_keep(
    const SequencePattern& pattern, const std::vector<int>& frames, Size size,
    ExistingFrames existing, const std::vector<std::pair<std::string, std::string>>& recipe);

/// Returns true if the picture carries the recipe that Weft writes into each of its frames.
[[nodiscard]] bool is_frame_of_weft(const std::string& path);
/// "PATH was not rendered by Weft …": what a run that goes on says instead of replacing it.
[[nodiscard]] Error not_of_weft(const std::string& path);

}  // namespace weft
