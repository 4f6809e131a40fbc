#pragma once
#include <string>

#include "app/project/project.h"
#include "engine/media/frame_reader.h"

namespace weft {

/// Takes out of a region what lies before the plate's first frame or after its last one: painted
/// mattes, confirmed parts, frozen mattes, corrections and reference frames, as when editorial has
/// trimmed the shot. What would be left without any painted matte, or without a reference frame
/// that was set, keeps them, for check_named_frames() to refuse. Returns what was left out, for a
/// warning, or an empty text.
[[nodiscard]] std::string leave_out_trimmed(Region& region, const FrameReader& plate);

}  // namespace weft
