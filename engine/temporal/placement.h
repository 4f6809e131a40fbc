#pragma once
// Where the artist puts the texture on the reference frame.

#include <array>
#include <memory>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/fields.h"
#include "engine/core/pixel_aspect.h"
#include "engine/core/texture_mapping.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// A texture plane laid on the reference frame. Without corners the plane's texel u lies,
/// unsqueezed (PixelAspect), at offset + scale · R(rotate) · u: turned counter-clockwise as seen on
/// the screen, about the place `offset`, which is the placement's origin.
struct PlanePlacement {
    float scale = 1;       ///< Unsqueezed plate pixels per sample pixel at the origin, > 0.
    float rotate_deg = 0;  ///< Counter-clockwise.
    Vec2 offset_px{0, 0};  ///< Of the origin, in plate pixels.
    /// Top left, top right, bottom right, bottom left on the plate: where a rectangle of the plane
    /// comes to lie in perspective. Its size in texels is such that `scale` holds along both edges
    /// at the top left corner, which is the origin; rotation and offset then act in the plane.
    std::optional<std::array<Vec2, 4>> corners;
    /// Of a given picture: its own corners go to `corners` at a scale of 1, whatever its size.
    std::optional<Size> picture_texels;
    /// A correction of the plane on the reference frame, beneath all of the above; null: none.
    std::shared_ptr<const PlaneWarp> warp;
    PixelAspect aspect;  ///< Of the plate.
    bool operator==(const PlanePlacement&) const = default;
};

/// From pixels of the reference frame to texels. Errors: Usage when the scale is not positive or
/// the corners are not a convex quadrilateral.
[[nodiscard]] Expected<TextureMapping> texture_mapping(const PlanePlacement& placement);

/// The texture coordinates of every pixel centre of `area` of a frame: where it was on the
/// reference frame (`ref_from_cur`), then through the mapping.
[[nodiscard]] TextureCoords texture_coords(const LatticeField& ref_from_cur,
                                           const TextureMapping& mapping, const Recti& area);

}  // namespace weft
