#pragma once
// Internal: what a surface is in a picture (a wall, the ground, a garment …), and which materials
// serve as it: a wall is replaced by what walls are made of.

#include <array>
#include <string_view>

#include "engine/core/image.h"

namespace weft {

enum class SurfaceRole { kWall, kGround, kRoof, kGarment, kCoat, kProp, kElement };
inline constexpr std::size_t kSurfaceRoles = 7;

/// One weight ≥ 0 for each role.
using RoleWeights = std::array<float, kSurfaceRoles>;

/// How usual a material of the vocabulary is as each role, 0 … 1; 0.4 throughout for another name.
[[nodiscard]] RoleWeights roles_of_material(std::string_view material);

/// Where in its frame a region lies, each 0 … 1.
struct RegionPlace {
    float bottom = 0, top = 0, left = 0, right = 0;  ///< Share of the frame's edge that it covers.
    float area = 0;                                  ///< Share of the frame.
    float solidity = 1;   ///< Area of the region by that of its convex hull: 1 for a plain outline.
    float first_row = 0;  ///< Where it begins, from the top of the frame.
};
/// `coverage` of the frame's size; 128 and above is inside.
[[nodiscard]] RegionPlace place_of_region(ViewU8x1 coverage);

/// How much more or less likely than usual each role is at a place: the ground lies at the bottom,
/// walls are large and reach the frame's sides, garments, animals and props stand free.
[[nodiscard]] RoleWeights roles_of_place(const RegionPlace& place);

/// 1 for the roles that a region's name, or the path of its matte, speaks of ("left sleeve"), less
/// for those that a material in it may serve as, 0 for the others; 1 throughout for a name that
/// says nothing.
[[nodiscard]] RoleWeights roles_of_name(std::string_view name);

/// "a wall", "the ground", …
[[nodiscard]] std::string_view role_name(SurfaceRole role);

}  // namespace weft
