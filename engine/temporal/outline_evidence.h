#pragma once
// What a surface's outline says of a step, which takes most of a step's time.

#include <memory>
#include <mutex>

#include "engine/temporal/step_motion.h"

namespace weft {

/// Motion that was fitted to the pictures that judge it leads before any other one by chance, too.
/// In standard errors, by the median over a shot of the lead less the bias: walls, coats and a
/// torso have 3.5 to 16, cars of plain paint that turn 0.9 to 1.8. (blender_fox_gt's fox, whose
/// speckle is new in each frame, leads by -2.9 to 0.6, flat drawn fills by -5 to 0.4.)
constexpr double kOfTheFit = 2.6;

/// Little structure for one pixel, less than this (structure_to_noise()): faint plaster and a flat
/// fill have as little.
constexpr float kStandsOut = 1.25f;

/// prev_from_cur as the outlines of the two frames have it. Pure.
[[nodiscard]] LatticeField outline_motion(const StepFrame& prev, const StepFrame& cur,
                                          int spacing_px);

/// Adds what the outline says to what the picture inside has said: where structure is faint or runs
/// in one direction. `structure`: structure_to_noise() of the step. Pure.
void add_outline(const StepFrame& prev, const StepFrame& cur, const FlowField& prev_from_cur,
                 float structure, int spacing_px, StepEvidence& out);

/// What is left open of a step, found when it is first asked for. Thread-safe.
class OutlineEvidence {
  public:
    /// `structure`: structure_to_noise() of the step.
    OutlineEvidence(StepEvidence of_picture, std::shared_ptr<const StepFrame> prev,
                    std::shared_ptr<const StepFrame> cur, float structure, int spacing_px);
    /// All that the two frames say (gather_evidence()).
    [[nodiscard]] const StepEvidence& whole() const;

  private:
    mutable StepEvidence evidence_;  // whole once it was asked for
    std::shared_ptr<const StepFrame> prev_, cur_;
    float structure_;
    int spacing_px_;
    mutable std::once_flag asked_;
};

}  // namespace weft
