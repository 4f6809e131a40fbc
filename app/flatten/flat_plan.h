#pragma once
// What is opened, analysed and gathered for a flat picture.

#include <vector>

#include "app/flatten/flatten_job.h"
#include "app/shot/shot.h"

namespace weft {

struct FlatPlan {
    ShotPlan plan;   ///< The shot's with all of the plate's light and without the rest of its look.
    int region = 0;  ///< In plan.regions.
    std::vector<int> frames;
    bool has_texture = false;
};

/// The project that is opened: the one region's light is the plate's, its texture stays if
/// `textures`. Errors: Usage, as run_flatten().
[[nodiscard]] Expected<Project> flat_project(const FlattenSpec& spec);
/// Whether all enabled regions have a texture, so that the shot can be opened with them.
[[nodiscard]] bool all_have_textures(const Project& project);

/// `shot`: of flat_project(). Errors: Usage and MissingFrames, as run_flatten().
[[nodiscard]] Expected<FlatPlan> plan_flat(const FlattenSpec& spec, const Shot& shot);

}  // namespace weft
