#pragma once
// Whether a drawn form can be used on its region.

#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/form/drawn_surface.h"

namespace weft {

/// The surface that guides stand for: of their shape, else of their parallel strokes. Errors: those
/// of drawn_surface() and drawn_plane().
[[nodiscard]] Expected<DrawnSurface> surface_of_guides(const std::vector<FormGuide>& guides,
                                                       const DrawnCamera& camera);

/// Errors where one of the strokes lies outside of the region, by its visible matte on the
/// reference frame, H×W of `camera.picture`. Errors: Usage.
[[nodiscard]] Status check_strokes(const std::vector<FormGuide>& guides, FormGuideKind kind,
                                   ViewU8x1 visible);

/// All that can be wrong with a drawn form is that it stands for no surface, or for none that the
/// region shows. Takes some milliseconds for a picture of any size. Errors: Usage, with what to do.
/// Thread-safe.
[[nodiscard]] Status check_drawn_form(const std::vector<FormGuide>& guides,
                                      const DrawnCamera& camera, ViewU8x1 visible);

}  // namespace weft
