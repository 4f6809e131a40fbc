#pragma once
// The form of a surface by the straight lines of one picture. Internal to the folder.

#include "engine/pipeline/form_motion.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// Where motion does not tell the form of a surface, since the camera stands still, turns or zooms,
/// one frame is all there is or the tracks are not good enough: the plane that the lines of the
/// reference frame show (plane_in_picture()), surely if the surface seems to bend. `moved`: what
/// form_from_motion() says; it is returned where motion does tell, where the surface is said to be
/// cloth or a body, and where the lines show no plane. Errors: those of the source; cancellation.
/// Thread-safe.
[[nodiscard]] Expected<FormMap> form_from_lines(const PassContext& context, int region,
                                                const std::vector<FormEvidence>& evidence,
                                                const MotionLens& lens, FormMap moved);

}  // namespace weft
