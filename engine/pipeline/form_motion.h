#pragma once
#include <optional>
#include <vector>

#include "engine/form/form_map.h"
#include "engine/form/rigid_fit.h"
#include "engine/pipeline/form_evidence.h"

namespace weft {

/// What is known of the lens before a region's motion is looked at.
struct MotionLens {
    std::optional<double> fov_deg = {};        ///< Horizontal field of view, as given.
    std::optional<TangentBelief> shared = {};  ///< What the shot's regions say together,
    int regions = 0;                           ///< so many of them.
};

/// Long side over focal length of a horizontal field of view, if one is given.
[[nodiscard]] std::optional<double> tangent_of(std::optional<double> fov_deg, Size plate);

/// The rigid surface that explains the motion. `evidence`: the reference frame first. Empty where
/// form_from_motion() is flat. Thread-safe.
[[nodiscard]] std::optional<RigidFit> fit_motion(const std::vector<FormEvidence>& evidence,
                                                 Size plate, const MotionLens& lens);

/// The form of a surface from its motion, if it moves as one rigid thing before a camera that sees
/// it from several sides (fit_rigid_surface()). `evidence`: the reference frame first. Without a
/// field of view that is found as well. Where the motion does not tell, the result is flat; its
/// finding is of kNone, with the number of frames that could be compared and, where they are those
/// of a rigid thing, with the form that was not believed and its field of view (else 0).
/// Thread-safe.
[[nodiscard]] FormMap form_from_motion(const std::vector<FormEvidence>& evidence, Size plate,
                                       const MotionLens& lens);

}  // namespace weft
