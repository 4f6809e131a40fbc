#pragma once
// The pictures of a motion export: ST-maps and vectors.

#include <cstdint>
#include <vector>

#include "app/motion_export/motion_paths.h"
#include "engine/media/frame_writer.h"
#include "engine/pipeline/region_motion.h"

namespace weft {

struct MotionFramesInputs {
    const MotionJobSpec& spec;
    const Shot& shot;
    const MotionPlan& motion;
    const MotionRegion& region;
    const MotionPaths& paths;
    const RegionMotion& surface;
    WriteRule rule;
};

/// Pictures written, and kept of an earlier run.
struct MotionPictures {
    std::int64_t written = 0, kept = 0;
};

/// Writes all pictures of a frame of a region. With kResume those are kept that can be read and
/// were made of the same motion with the same settings. Thread-safe. Errors: those of the analysis
/// and of the disk.
[[nodiscard]] Expected<MotionPictures> write_motion_frame(const MotionFramesInputs& in, int frame);

}  // namespace weft
