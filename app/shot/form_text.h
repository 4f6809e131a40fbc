#pragma once
#include <string>

#include "app/project/project.h"
#include "engine/form/form_map.h"

namespace weft {

/// What the form of a region was found from, and how sure it is, in one line: "Plane, from 38
/// frames of motion, tilted 71° ± 2°".
[[nodiscard]] std::string form_text(const FormParams& form, const FormFinding& finding);

}  // namespace weft
