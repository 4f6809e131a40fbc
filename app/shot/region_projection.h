#pragma once
// A region of the document as the pipeline needs it: one function for each struct of parameters.
// They set their own part of a plan, open no file and depend on no other part unless they say so.

#include "app/project/project.h"
#include "engine/pipeline/region_plan.h"

namespace weft {

/// Errors: Usage when the region or a holdout has no matte.
[[nodiscard]] Status project_mattes(const MatteSource& matte,
                                    const std::vector<MatteSource>& holdouts, RegionPlan& plan);
/// Errors: Usage when a zone has no matte.
[[nodiscard]] Status project_zones(const std::vector<Zone>& zones, RegionPlan& plan);

/// Pins on the plate; their frames become reference frames after those that `plan` has.
void project_corrections(const std::map<int, std::vector<CorrectionPin>>& corrections,
                         RegionPlan& plan);

/// Files of true motion. A track is read by whoever may open files. Errors: Usage for both at once.
[[nodiscard]] Status project_motion(const MotionSource& motion, RegionPlan& plan);

/// Errors: Usage where keys or a UV pass are given for a mode that makes the texture where it lies,
/// and for corners that no plane has.
[[nodiscard]] Status project_placement(const Placement& placement, TemporalMode mode,
                                       RegionPlan& plan);

void project_synthesis(const SynthesisParams& synthesis, RegionPlan& plan);
void project_temporal(const TemporalParams& temporal, RegionPlan& plan);

/// `display_referred`: as ShotPlan has it; else gains are not limited. Errors: Usage for painted
/// light without lamps and for exact light without a pass.
[[nodiscard]] Status project_light(const LightParams& light, bool display_referred,
                                   RegionPlan& plan);

/// In draft quality there is no grain, defocus or motion blur.
void project_finish(const FinishParams& finish, FlowQuality quality, RegionPlan& plan);
void project_lines(const LineParams& lines, RegionPlan& plan);

}  // namespace weft
