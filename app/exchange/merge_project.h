#pragma once
// Merges what two writers made of one project: regions by id, settings one by one, keys by frame.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/project/project.h"
#include "engine/core/error.h"

namespace weft {

/// What both writers changed, each in another way.
struct MergeConflict {
    std::string region;        ///< Its name; empty: the project.
    std::string key;           ///< "placement.scale", "matte.keyframes"; empty: all of it.
    std::optional<int> frame;  ///< Of a key.
    std::string mine, theirs;  ///< The two values, as short text.
    bool operator==(const MergeConflict&) const = default;
};

enum class MergeSide : std::uint8_t { kMine, kTheirs };

struct MergedProject {
    Project project;
    std::vector<MergeConflict> conflicts;
    /// Regions that "theirs" added, changed or removed, by name; "the project" stands for its own
    /// settings. In the order of the layers.
    std::vector<std::string> changed;
    /// Regions that "mine" added under an id that "theirs" took for another: old id → new id.
    std::map<RegionId, RegionId> renumbered;
};

/// Applies the changes from `base` to `mine` and those from `base` to `theirs`. What only one of
/// them changed is as there; what both changed is as on the side `wins`, and listed. What depends
/// on each other is taken from one side: locked patches and their sample, the placement and its
/// reference frame, frozen mattes and what they were made from. Pure, thread-safe. Errors: Usage (a
/// project that cannot be written, as a path that is not UTF-8).
[[nodiscard]] Expected<MergedProject> merge_projects(const Project& base, const Project& mine,
                                                     const Project& theirs, MergeSide wins);

}  // namespace weft
