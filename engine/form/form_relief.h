#pragma once
// The surface in front of the camera, from its metric.

#include "engine/form/form_map.h"
#include "engine/form/metric_field.h"
#include "engine/form/view_camera.h"

namespace weft {

/// ln of the depth of a surface along the camera's axis, in the unit of what was added to `field`,
/// over the field's rectangle (first component), and how well it is known: 1 where there is
/// evidence, 0 where the metric is only continued (second component). `known_beyond`: it is known
/// there as well, as on a plane. Against rays of length 1 a surface's metric has the square of the
/// distance as its smaller eigenvalue, however it is tilted, so no integration is needed. `field`
/// must be finished. Thread-safe.
[[nodiscard]] LatticeField relief_from_metric(const MetricField& field, const ViewCamera& camera,
                                              bool known_beyond);

/// Fills the form's relief as a camera of that horizontal field of view shows it.
void add_relief(FormMap& form, const MetricField& field, double fov_deg, Size picture,
                bool known_beyond);

/// The horizontal field of view, in degrees, in which the depths that relief_from_metric() finds
/// have slopes that agree with the metric's tilt. 49° where the surface hardly tells. Thread-safe.
[[nodiscard]] double fov_of_metric(const MetricField& field, Size picture);

}  // namespace weft
