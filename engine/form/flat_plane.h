#pragma once
// A plane laid flat.

#include <glm/vec3.hpp>

#include "engine/form/form_map.h"
#include "engine/form/metric_field.h"
#include "engine/form/view_camera.h"

namespace weft {

/// A plane n · P = 1 in view space, in front of a camera.
struct SeenPlane {
    glm::dvec3 normal{0, 0, 1};
    ViewCamera camera;

    /// The reciprocal of the depth at a place of the picture.
    [[nodiscard]] double nearness(Vec2 place) const;
};

/// Where the places of a plane lie when it is laid flat: one homography of the picture, exact at
/// the nodes of the field's lattice, turned and scaled as flat_from_reference() does. Further away
/// than `least_nearness` (above 0), where nothing is seen and the horizon lies, depth grows evenly
/// over the picture instead, so that nothing folds over. `field` must be finished; its metrics are
/// not asked, but where it has evidence. Bit-identical everywhere; thread-safe.
[[nodiscard]] FormMap flat_plane(const SeenPlane& plane, double least_nearness,
                                 const MetricField& field);

}  // namespace weft
