#pragma once
// The files of a motion export.

#include <optional>
#include <string>
#include <vector>

#include "app/motion_export/motion_plan.h"
#include "engine/media/sequence_pattern.h"
#include "engine/media/write_rule.h"

namespace weft {

/// "nuke", "fusion" or "blender".
[[nodiscard]] const char* name_of(StConvention convention);
/// "blender", "nuke", "moonray", "flame" or "arnold".
[[nodiscard]] const char* name_of(MotionConvention convention);

/// Of one region; relative to the export's folder.
struct MotionPaths {
    std::string folder;
    /// One pattern that holds both ways, or one for each (`stabilize` empty: the first).
    std::string st_map, stabilize;
    std::vector<std::pair<MotionConvention, std::string>> vectors;
    /// Corner pins: Nuke, After Effects, Blender, Weft.
    std::string nuke, after_effects, blender, track;
    /// Roto shapes: Nuke, Blender, MLT.
    std::string nuke_shapes, blender_shapes, mlt_shapes;
    /// The mesh: OBJ, PC2, USD.
    std::string mesh_obj, mesh_pc2, mesh_usd;
};

/// One for each region. Folders are named after the regions, with _ for all but letters, digits,
/// - and _, and numbered where two are the same.
[[nodiscard]] std::vector<MotionPaths> motion_paths(const MotionJobSpec& spec,
                                                    const std::vector<MotionRegion>& regions);

/// The manifest's name in the folder.
inline constexpr const char* kMotionManifest = "motion.json";

/// A file or a pattern of an export, by its whole path. Errors: Usage for a folder whose name holds
/// a placeholder.
[[nodiscard]] Expected<SequencePattern> motion_pattern(const std::string& folder,
                                                       const std::string& relative);

/// Checks all files before any work, and creates nothing. Errors: Usage (one exists and must not,
/// or is not of an earlier export; an input; outside the root), Unreadable, NoSpace.
[[nodiscard]] Status check_motion_files(const MotionJobSpec& spec, const MotionPlan& motion,
                                        const std::vector<MotionPaths>& paths,
                                        const WriteRule& rule);

}  // namespace weft
