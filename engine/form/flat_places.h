#pragma once
// Internal to the folder: places on a surface that is laid flat, as a form.

#include <glm/vec2.hpp>
#include <vector>

#include "engine/form/form_map.h"
#include "engine/form/metric_field.h"

namespace weft {

/// The form whose nodes lie at `flat`, row by row, in the order of a LatticeField over the field's
/// domain: turned and scaled so that, over the evidence inside of the reference frame (all of it if
/// there is none), it is on average as upright and in the median as large as the picture, and its
/// centre stays where it is.
[[nodiscard]] FormMap form_of_places(const MetricField& field, std::vector<glm::dvec2> flat);

}  // namespace weft
