#pragma once
#include <string>

#include "engine/media/write_rule.h"
#include "engine/motion/corner_track.h"

namespace weft {

/// Reads a planar track: Weft's JSON ("weft.track/1", docs/FORMATS.md) or a format of
/// parse_corner_track(). Errors: Unreadable with the path and the reason.
[[nodiscard]] Expected<CornerTrack> read_corner_track(const std::string& path,
                                                      const CornerTrackContext& context);

/// Writes a track as "weft.track/1". Errors: those of write_file_atomically().
[[nodiscard]] Status write_corner_track(const std::string& path, const CornerTrack& track,
                                        const WriteRule& rule);

}  // namespace weft
