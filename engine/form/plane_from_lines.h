#pragma once
#include <optional>
#include <vector>

#include "engine/form/picture_lines.h"
#include "engine/form/rigid_surface.h"

namespace weft {

struct PlaneFromLines {
    RigidSurface surface;                     ///< A plane: without relief.
    double tilt_deg = 0, tilt_error_deg = 0;  ///< Against the picture, and its standard error.
};

/// The plane on which the lines `along` are parallel, and the lines `across` at right angles to
/// them: the most likely slopes, direction and focal length, by Levenberg–Marquardt from many
/// starts. A line's error is how far its ends are off the line through its middle and the vanishing
/// point, as drawn by hand to a pixel. Before there is evidence a plane faces the camera, and
/// fields of view are as they are common; so two lines alone give the plane with the farthest
/// horizon through their vanishing point: a floor for lines that run away from below. `tangent`:
/// long side over focal length, where it is known. Lines that would be at right angles only for a
/// lens that nobody uses need not be: their angle is then as likely as it is drawn. Deterministic
/// everywhere; thread-safe.
[[nodiscard]] PlaneFromLines plane_from_lines(const std::vector<PictureLine>& along,
                                              const std::vector<PictureLine>& across, Size picture,
                                              std::optional<double> tangent);

}  // namespace weft
