#pragma once
// A surface as a mesh of quads over time, and as files of other programs.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/image.h"

namespace weft {

/// Equal corners, faces and order on all frames. A unit is a pixel of the plate: x to the right, y
/// up from the picture's lower left corner, z towards the camera.
struct SurfaceMesh {
    Size picture;
    int reference = 0;
    std::vector<Vec2> uv;  ///< Of each corner: its place on the reference frame, 0–1, y up.
    std::vector<std::array<std::uint32_t, 4>> faces;  ///< Counterclockwise as the camera sees them.
    std::map<int, std::vector<Vec3>> corners;  ///< By frame; with the reference frame. All as many.
    bool depth = false;                        ///< z is known; 0 otherwise.
};

/// Squares of `step_px` over all of a matte that is covered by half, where it shows any of it; only
/// the corners that they need, at z = 0 on the reference frame. No faces: it shows nothing. Pure.
[[nodiscard]] SurfaceMesh mesh_over(ViewU8x1 matte, int reference, int step_px);

/// Wavefront OBJ of the reference frame, with texture coordinates. Pure, as are those below; equal
/// meshes give equal bytes on every machine.
[[nodiscard]] std::string mesh_obj(const SurfaceMesh& mesh, std::string_view name);
/// A PC2 point cache (POINTCACHE2, version 1, little endian, 32-bit floats) of the corners in the
/// OBJ's order: a sample for each frame from the first to the last of `frames` (ascending); on
/// those that it lacks the corners are between their neighbours.
[[nodiscard]] std::string mesh_pc2(const SurfaceMesh& mesh, const std::vector<int>& frames);
/// USD as text: a mesh with a time sample for each of `frames` and the texture coordinates `st`.
/// `name`: letters, digits and _.
[[nodiscard]] std::string mesh_usd(const SurfaceMesh& mesh, std::string_view name,
                                   const std::vector<int>& frames, double fps);

}  // namespace weft
