#pragma once
// Renderers' passes of paint and of light.

#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/media/frame_reader.h"

namespace weft {

enum class LightPass {
    kAlbedo,   ///< The surface's colour without light.
    kLighting  ///< The light on a white surface.
};

/// The layer that holds the pass; several joined by "+" are to be added up. Empty: the picture of a
/// file that has nothing else. Of an EXR with several layers: DiffCol (Blender), albedo and the
/// like; DiffDir + DiffInd, or V-Ray's rawTotalLighting; of several that beside one of `beside`, as
/// find_pass(). Errors: Unreadable, listing the layers, if none of them is there.
[[nodiscard]] Expected<std::string> find_light_layer(const std::string& path, LightPass pass,
                                                     const std::vector<std::string>& beside = {});

/// Do both layers (of the same file) mean the same channels, as where the plate is taken for its
/// own albedo? Empty: the file's picture; any file but an EXR has only that.
[[nodiscard]] bool is_same_picture(const std::string& path, const std::string& layer,
                                   const std::string& other);

/// The pass in `layer`, as find_light_layer() names it; empty: found. Errors: Unreadable.
[[nodiscard]] Expected<PlateFrame> read_light_pass(const std::string& path, LightPass pass,
                                                   const std::string& layer);

}  // namespace weft
