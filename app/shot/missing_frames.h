#pragma once
#include <memory>
#include <vector>

#include "app/project/project.h"
#include "engine/media/frame_reader.h"

namespace weft {

/// Wraps the plate so that missing frames are replaced between its first and last frame, and for
/// the frames of `wanted` beyond. read() returns the previous frame (the first one if there is
/// none); shown_frame() says which. With kError, returns the plate unchanged.
[[nodiscard]] std::shared_ptr<const FrameReader> with_missing_frames(
    std::shared_ptr<const FrameReader> plate, MissingFrames policy, const std::vector<int>& wanted);

}  // namespace weft
