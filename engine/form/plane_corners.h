#pragma once
#include <optional>

#include "engine/core/image.h"
#include "engine/core/quad.h"
#include "engine/form/form_map.h"

namespace weft {

/// The corners of an upright rectangle on a form that is a plane, as the reference frame shows
/// them (plate pixels): as large as fits into the box around the matte, which is of the reference
/// frame. Empty where the form is none (that of a pass is one if it is a homography), or the matte
/// too small. Thread-safe.
[[nodiscard]] std::optional<Quad<float>> plane_corners(const FormMap& form, ViewU8x1 matte);

}  // namespace weft
