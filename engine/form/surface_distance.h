#pragma once
// How differently two surfaces lay a texture.

#include <vector>

#include "engine/core/geometry.h"
#include "engine/form/rigid_surface.h"

namespace weft {

constexpr double kImpossibleStretch = 1;  ///< ln, from a shape that cannot be there.

/// ½ ln of the ratio of the eigenvalues of a⁻¹ b: ln stretch between two laid surfaces.
[[nodiscard]] double log_stretch_between(const Metric& a, const Metric& b);

/// ln stretch between two surfaces, and between the flat picture and one: root mean squares.
[[nodiscard]] double log_stretch_between(const RigidSurface& a, const RigidSurface& b,
                                         const std::vector<Vec2>& places);
[[nodiscard]] double log_stretch_of(const RigidSurface& surface, const std::vector<Vec2>& places);

/// Between the surface at its centre and the picture plane there, degrees.
[[nodiscard]] double tilt_of(const RigidSurface& surface);

/// The horizontal field of view of a tangent (long side over focal length), degrees.
[[nodiscard]] double fov_of_tangent(double tangent, Size picture);

}  // namespace weft
