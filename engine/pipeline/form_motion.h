#pragma once
#include <optional>
#include <vector>

#include "engine/form/form_map.h"
#include "engine/pipeline/form_evidence.h"

namespace weft {

/// The form of a surface from its motion, if it moves as one rigid thing before a camera that sees
/// it from several sides (fit_rigid_surface()). `evidence`: the reference frame first. `fov_deg`:
/// horizontal field of view; empty: found as well. Where the motion does not tell, the result is
/// flat; its finding is of kNone, with the number of frames that could be compared and, where they
/// are those of a rigid thing, with the form that was not believed and its field of view (else 0).
/// Thread-safe.
[[nodiscard]] FormMap form_from_motion(const std::vector<FormEvidence>& evidence, Size plate,
                                       std::optional<double> fov_deg);

}  // namespace weft
