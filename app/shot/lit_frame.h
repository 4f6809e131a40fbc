#pragma once
// Whether a plate's frame shows anything, by its light as a whole: a shot may fade in from black or
// begin with a flash.

#include <optional>
#include <vector>

#include "app/shot/reference_choice.h"
#include "engine/media/frame_cache.h"

namespace weft {

/// The mean luminance of a frame, display white 1; 0 if it is black or burnt out, so that it shows
/// nothing. Nothing if it cannot be read.
[[nodiscard]] std::optional<double> light_of_frame(const CachedReader& plate, int frame,
                                                   VisibilityCache* memory);

/// True if frames of this light may show too little; only then others are looked at.
[[nodiscard]] bool is_doubtful(double light);

/// The frame of `candidates` (ascending) nearest to `frame` that has the light of the shot, if
/// `frame` itself has less than a third of it. Reads up to 24 frames, if that one is_doubtful().
[[nodiscard]] std::optional<int> lit_frame(const CachedReader& plate, int frame,
                                           const std::vector<int>& candidates,
                                           VisibilityCache* memory);

}  // namespace weft
