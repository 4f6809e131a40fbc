#pragma once
#include <string>
#include <vector>

#include "app/motion_export/motion_paths.h"
#include "engine/pipeline/region_corners.h"
#include "engine/pipeline/region_shapes.h"

namespace weft {

/// What an export says of a mesh.
struct MeshSummary {
    std::size_t corners = 0, faces = 0;
    bool depth = false;
};

/// What an export says of itself.
struct MotionManifest {
    bool complete = false;
    Size size;
    double fps = 24;
    std::vector<int> frames;
    struct Entry {
        MotionRegion region;
        MotionPaths paths;
        std::optional<RegionCorners> corners;     ///< Empty: it has no corner pin.
        std::optional<RegionShapes> shapes = {};  ///< Empty: it has no roto shapes.
        std::optional<MeshSummary> mesh = {};     ///< Empty: it has no mesh.
    };
    StConvention st = StConvention::kNuke;
    std::vector<Entry> regions;
};

/// Its JSON, "weft.motion/1" (docs/schemas/motion.schema.json). Pure.
[[nodiscard]] std::string manifest_text(const MotionManifest& manifest);

}  // namespace weft
