#pragma once
#include <string>

#include "engine/motion/corner_track.h"

namespace weft {

/// Reads a planar track: Weft's own JSON ("weft.track/1", docs/FORMATS.md), or what
/// parse_corner_track() reads. Errors: Unreadable with the path and what is wrong.
[[nodiscard]] Expected<CornerTrack> read_corner_track(const std::string& path,
                                                      const CornerTrackContext& context);

}  // namespace weft
