#pragma once
// Finds frames of an earlier run that can be kept.

#include <vector>

#include "app/render/render_job.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

/// Returns those of `frames` that are kept, ascending. `recipe`: the metadata of the new frames.
/// Errors: Usage when frames exist and must not; when a frame to replace was not written by Weft
/// (except with kOverwrite); when frames were rendered with the same settings on another backend,
/// whose pixels may differ.
[[nodiscard]] Expected<std::vector<int>> frames_to_keep(
    const SequencePattern& pattern, const std::vector<int>& frames, Size size,
    ExistingFrames existing, const std::vector<std::pair<std::string, std::string>>& recipe);

/// Returns true if the image holds the recipe metadata that Weft writes.
[[nodiscard]] bool is_frame_of_weft(const std::string& path);
/// "PATH was not rendered by Weft …": the error of a resumed run that will not replace it.
[[nodiscard]] Error not_of_weft(const std::string& path);

}  // namespace weft
