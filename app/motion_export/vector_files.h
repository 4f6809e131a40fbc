#pragma once
#include <string>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"

namespace weft {

/// The motion of a surface from a frame to those beside it. H×W of the plate.
struct FrameVectors {
    /// Pixels, y down: what the frame shows at p lies at p + d on the other one. 0 where `visible`
    /// is 0, and on a frame without such a neighbour.
    ImageF2 forward, backward;
    bool has_forward = false, has_backward = false;
    ImageF1 visible;  ///< How much of the surface the frame shows there, 0–1.
    /// Of the matte, the least of the frame and those beside it, 0–1.
    float confidence = 1;
};

/// Writes an EXR of 32 bit floats without loss, as read_motion() reads this convention, which is
/// not kFiles (docs/FORMATS.md). A convention with one vector gets the forward one; where there is
/// none, the backward one turned round. `write` gives metadata and rule. Errors: as write_exr().
[[nodiscard]] Status write_vectors(const std::string& path, const FrameVectors& vectors,
                                   MotionConvention convention, WriteOptions write);

}  // namespace weft
