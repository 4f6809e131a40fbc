#pragma once
// Internal: the role of a surface in a picture (a wall, the ground, a garment …) and the materials
// that are usual for it.

#include <array>
#include <string_view>

#include "engine/core/image.h"

namespace weft {

enum class SurfaceRole { kWall, kGround, kRoof, kGarment, kCoat, kProp, kElement };
inline constexpr std::size_t kSurfaceRoles = 7;

/// One weight ≥ 0 for each role.
using RoleWeights = std::array<float, kSurfaceRoles>;

/// How usual a material of the vocabulary is for each role, 0 … 1; 0.4 for unknown materials.
[[nodiscard]] RoleWeights roles_of_material(std::string_view material);

/// Position of a region in its frame, each 0 … 1.
struct RegionPlace {
    float bottom = 0, top = 0, left = 0, right = 0;  ///< Share of the frame's edge that it covers.
    float area = 0;                                  ///< Share of the frame.
    /// Area of the region over that of its convex hull: 1 for a plain outline.
    float solidity = 1;
    float first_row = 0;  ///< Its first row, from the top of the frame.
};
/// `coverage` has the frame's size; 128 and above is inside.
[[nodiscard]] RegionPlace place_of_region(ViewU8x1 coverage);

/// How much more or less likely than usual each role is at a position: the ground lies at the
/// bottom, walls are large and reach the frame's sides, garments, animals and props stand free.
[[nodiscard]] RoleWeights roles_of_place(const RegionPlace& place);

/// 1 for the roles that a region's name, or the path of its matte, names ("left sleeve"), less for
/// roles that a material in the name may have, 0 for the others; 1 for all if the name names none.
[[nodiscard]] RoleWeights roles_of_name(std::string_view name);

/// "a wall", "the ground", …
[[nodiscard]] std::string_view role_name(SurfaceRole role);

}  // namespace weft
