#pragma once
// What a region shows of its form on a frame. Internal to the folder.

#include <vector>

#include "engine/form/metric_field.h"
#include "engine/motion/lattice_field.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// The weight of places that the reference frame does not show: a frame's coordinates are as good
/// as its motion was followed; the reference frame's are exact.
inline constexpr double kOtherFrames = 0.01;

/// Unsqueezed, as all that is found of a form is: its cameras have square pixels.
struct FormEvidence {
    Matte visible;
    LatticeField ref_from_cur;
};

/// Of all `frames`, the reference frame first. Needs their mattes and kCoords. Errors: those of the
/// source and the store; cancellation.
[[nodiscard]] Expected<std::vector<FormEvidence>> form_evidence_on(const PassContext& context,
                                                                   const AnalysisStore& store,
                                                                   int region,
                                                                   const std::vector<int>& frames);

/// A field, still empty, over the reference frame and all that the evidence shows beyond it, at
/// most a frame's size away.
[[nodiscard]] MetricField field_over(Size plate, const std::vector<FormEvidence>& evidence);

/// A field, still empty, over a rectangle of the reference frame's plane.
[[nodiscard]] MetricField field_over(Size plate, const Recti& domain);

}  // namespace weft
