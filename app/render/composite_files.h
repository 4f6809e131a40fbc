#pragma once
// Node trees for other programs beside a render (app/composites), with the texture planes that they
// show through the ST-map.

#include <string>
#include <vector>

#include "app/shot/shot.h"
#include "engine/media/frame_writer.h"
#include "engine/media/sequence_pattern.h"
#include "engine/pipeline/region_scene.h"

namespace weft {

/// The project with the layers that node trees are built from; the same if `files` is empty.
[[nodiscard]] Project with_composite_layers(Project project, const std::vector<std::string>& files);

/// Where the pictures of a render are.
struct CompositeSources {
    const Shot& shot;
    const ShotPlan& plan;
    std::vector<int> frames;  ///< Of the whole run, kept ones included; ascending.
    SequencePattern layers;   ///< The EXR files that hold the layers.
    bool apart = false;       ///< They are not the frames' own.
};

/// The files that write_composites() writes: the trees, then a plane for each region that has one.
[[nodiscard]] std::vector<std::string> composite_outputs(const std::vector<std::string>& files,
                                                         const ShotPlan& plan);
/// Whether a file is one of them, by its beginning.
[[nodiscard]] bool is_composite_of_weft(const std::string& path);

/// Checks before any work that the trees can be written. Errors: Usage for a name that ends neither
/// in .nk, .comp nor .py, for a plate that is a movie, has a straight alpha, is in a colour space
/// that the programs do not have, or whose names end in another number; for layers that Blender
/// would not show; those of reading a frame.
[[nodiscard]] Status check_composites(const std::vector<std::string>& files,
                                      const CompositeSources& sources);

/// Writes the trees and the planes: graded, in the working space, 32 bit. Paths in a tree are
/// relative to its folder. `scenes` may be empty if the planes are there. `rules`: of each of
/// composite_outputs(). Errors: as write_file_atomically() and write_image().
[[nodiscard]] Status write_composites(const std::vector<std::string>& files,
                                      const CompositeSources& sources,
                                      const std::vector<RegionScene>& scenes,
                                      const WriteOptions& write,
                                      const std::vector<WriteRule>& rules);

}  // namespace weft
