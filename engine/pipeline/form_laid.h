#pragma once
// A surface that was found in front of the camera, laid flat. Internal to the folder.

#include <vector>

#include "engine/form/form_map.h"
#include "engine/form/rigid_surface.h"
#include "engine/pipeline/form_evidence.h"

namespace weft {

/// A plane goes on for that share of the least nearness seen: what is further is the horizon, whose
/// areas would outweigh all that is seen.
inline constexpr double kGoesOn = 0.6;

/// A form that changes nothing.
[[nodiscard]] FormMap flat_over(Size plate, const FormFinding& finding);

/// The surface at the places that the evidence shows of it, the reference frame's first; a plane is
/// known beyond them too, but towards its horizon, and is laid as one homography, tilted as far as
/// it is believed. `finding` says whether it is one, and the field of view. Empty if no place shows
/// it. Thread-safe.
[[nodiscard]] FormMap laid_flat(const RigidSurface& surface, const FormFinding& finding,
                                const std::vector<FormEvidence>& evidence, Size plate);

}  // namespace weft
