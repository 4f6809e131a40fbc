#pragma once
#include <memory>
#include <vector>

#include "app/project/project.h"
#include "engine/media/frame_reader.h"

namespace weft {

/// The plate with something in place of the frames that it has not: between its first and its last,
/// and those of `wanted` beyond. read() gives the frame before (the first one where there is none),
/// shown_frame() says which. With kError the plate as it is.
[[nodiscard]] std::shared_ptr<const FrameReader> with_missing_frames(
    std::shared_ptr<const FrameReader> plate, MissingFrames policy, const std::vector<int>& wanted);

}  // namespace weft
