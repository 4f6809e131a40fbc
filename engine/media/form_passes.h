#pragma once
// Passes that show the shape of what a renderer saw: places, normals, depth, and the camera; and
// where a render's texture lies on it.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/media/pass_layers.h"

namespace weft {

/// A position pass: three channels (X, Y, Z or R, G, B) of half or float, the place of what each
/// pixel shows. Places of 1e10 and more and (0, 0, 0), renderers' background, are not finite here.
/// `layer`: the part of the names before ".X", or a part's name; empty: "Position", "P" or
/// "P_World", also behind another name. Errors: as read_motion().
[[nodiscard]] Expected<ImageF3> read_positions(const std::string& path, const std::string& layer,
                                               Size expected);

/// A normal pass: three channels as above, or a picture of 8 or 16 bits whose codes are
/// (n + 1) / 2. `layer` empty: "Normal", "N" or "normals", also behind another name. The background
/// may be zero. Errors: as read_motion().
[[nodiscard]] Expected<ImageF3> read_normals(const std::string& path, const std::string& layer,
                                             Size expected);

/// A depth pass of half or float: "depth.Z", any "….Depth.Z" or ".V", "Z" beside the picture, or
/// the first channel of a file of its own. `layer` as above. Infinite where nothing is seen: 1e10
/// and more, and 65504, the largest half. Errors: as read_motion(); Unreadable for codes of 8 or 16
/// bits, which have no scale.
[[nodiscard]] Expected<ImageF1> read_depth(const std::string& path, const std::string& layer,
                                           Size expected);

/// Where the functions above read an EXR; of several layers that beside one of `beside`:
/// find_pass(). Errors: as there.
[[nodiscard]] Expected<FoundPass> locate_positions(const std::string& path,
                                                   const std::string& layer,
                                                   const std::vector<std::string>& beside = {});
[[nodiscard]] Expected<FoundPass> locate_normals(const std::string& path, const std::string& layer,
                                                 const std::vector<std::string>& beside = {});
[[nodiscard]] Expected<FoundPass> locate_depth(const std::string& path, const std::string& layer,
                                               const std::vector<std::string>& beside = {});

/// The layer `st` that a render writes (docs/FORMATS.md, "Layers"): texture coordinates, 0–1,
/// origin at the bottom left. Errors: as read_motion().
[[nodiscard]] Expected<ImageF2> read_st_layer(const std::string& path, Size expected);

/// What the header of a rendered EXR says about its camera.
struct HeaderCamera {
    std::optional<double> fov_deg;  ///< Horizontal.
    /// The rotation from the world's axes into the camera's, by rows.
    std::optional<std::array<double, 9>> camera_from_world;
    bool by_blender = false;  ///< Its normals and places are in the world's axes.
};
/// From `cameraFov`, or `cameraAperture` and `cameraFocalLength` (V-Ray), and `worldToCamera`
/// (OpenEXR's standard attribute) or `cameraTransform` (V-Ray); nothing where they are missing or
/// make no sense. Blender writes none of them, but other attributes of its own. Errors: Unreadable.
[[nodiscard]] Expected<HeaderCamera> read_camera(const std::string& path);

}  // namespace weft
