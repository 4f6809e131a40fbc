#pragma once
// Finds frames of an earlier run that can be kept.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/render/render_job.h"
#include "engine/media/sequence_pattern.h"

namespace weft {

/// The recipe of the frames to render.
struct WantedRecipe {
    /// Metadata that all of them have.
    std::vector<std::pair<std::string, std::string>> metadata;
    /// "weft:inputs" of each (InputHashes::text()).
    std::map<int, std::string> inputs;
};

struct KeptFrames {
    std::vector<int> frames;  ///< Ascending.
    /// With kResume: which of the others exist and why they are not kept, a line for each reason.
    std::vector<std::string> notes;
};

/// Decides which of `frames` are kept. Errors: Usage when frames exist and must not; when a frame
/// to replace was not written by Weft (except with kOverwrite); when frames were rendered with the
/// same settings from the same inputs on another backend, whose pixels may differ.
[[nodiscard]] Expected<KeptFrames> frames_to_keep(const SequencePattern& pattern,
                                                  const std::vector<int>& frames, Size size,
                                                  ExistingFrames existing,
                                                  const WantedRecipe& recipe);

/// Returns true if the image holds the recipe metadata that Weft writes.
[[nodiscard]] bool is_frame_of_weft(const std::string& path);
/// "PATH was not rendered by Weft …": the error of a resumed run that will not replace it.
[[nodiscard]] Error not_of_weft(const std::string& path);

}  // namespace weft
