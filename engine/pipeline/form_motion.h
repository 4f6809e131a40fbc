#pragma once
#include <optional>
#include <vector>

#include "engine/form/form_map.h"
#include "engine/pipeline/form_evidence.h"

namespace weft {

/// The form of a surface from its motion, if it moves as one rigid thing before a camera that sees
/// it from several sides (fit_rigid_surface()). `evidence`: the reference frame first. `fov_deg`:
/// horizontal field of view; empty: found as well. Where the motion does not tell, the result is
/// flat, and its finding says so. Thread-safe.
[[nodiscard]] FormMap form_from_motion(const std::vector<FormEvidence>& evidence, Size plate,
                                       std::optional<double> fov_deg);

}  // namespace weft
