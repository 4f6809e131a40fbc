#pragma once
// Depth for the corners of a mesh.

#include <vector>

#include "engine/form/form_on_frame.h"

namespace weft {

/// The places in front of the camera of places of the reference frame (plate pixels), in the unit
/// of FormMap::relief: x to the right, y down, z into the scene. The form has a relief, which goes
/// on beyond what is known. `picture`: size of the plate. Pure.
[[nodiscard]] std::vector<glm::dvec3> places_in_space(const FormMap& form,
                                                      const std::vector<Vec2>& pixels,
                                                      Size picture);

/// What a corner of the mesh is on a frame.
struct SeenCorner {
    glm::dvec3 place{0};  ///< By places_in_space().
    double depth = 0;     ///< On the frame; 0: not seen.
};

/// The depth of all corners on a frame: as seen where they are, and of the others by the affine map
/// of places to depths that fits those best, which a rigid motion is. Empty with less than eight
/// that are seen. Pure.
[[nodiscard]] std::vector<double> depths_of(const std::vector<SeenCorner>& corners);

}  // namespace weft
