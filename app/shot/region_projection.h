#pragma once
// Converts a region of the document to the pipeline's plan: one function per parameter struct. Each
// sets its own part of the plan, opens no file and is independent of the others unless stated.

#include "app/project/project.h"
#include "engine/pipeline/region_plan.h"

namespace weft {

[[nodiscard]] MatteEdgePlan project_edge(const MatteEdgeParams& edge);
/// Frozen frames become keyframes with files, except where one is painted. Errors: Usage without
/// their files, or where the matte is not painted.
[[nodiscard]] Status add_frozen_mattes(Region& region);
/// Errors: Usage when the region or a holdout has no matte.
[[nodiscard]] Status project_mattes(const MatteSource& matte,
                                    const std::vector<MatteSource>& holdouts, RegionPlan& plan);
/// Errors: Usage when a zone has no matte.
[[nodiscard]] Status project_zones(const std::vector<Zone>& zones, RegionPlan& plan);

/// Adds the pins. Their frames become additional reference frames after those of `plan`.
void project_corrections(const std::map<int, std::vector<CorrectionPin>>& corrections,
                         RegionPlan& plan);

/// Sets the files of true motion. Tracks are read elsewhere, since this code opens no files.
/// Errors: Usage when both are given.
[[nodiscard]] Status project_motion(const MotionSource& motion, RegionPlan& plan);

/// Errors: Usage for keys or a UV pass in a mode that synthesizes the texture in place, and for
/// corners that no plane can have.
[[nodiscard]] Status project_placement(const Placement& placement, TemporalMode mode,
                                       PixelAspect aspect, RegionPlan& plan);

/// After project_placement(). Errors: Usage for a pass or shape in a mode that synthesizes the
/// texture in place, or beside a UV pass; for a source whose pass or drawing is missing, and for a
/// shape beside parallel strokes.
[[nodiscard]] Status project_form(const Region& region, RegionPlan& plan);

void project_synthesis(const SynthesisParams& synthesis, RegionPlan& plan);
void project_temporal(const TemporalParams& temporal, RegionPlan& plan);

/// `display_referred`: as in ShotPlan; otherwise gains are not limited. Errors: Usage for painted
/// light without lamps, and for exact light without a pass.
[[nodiscard]] Status project_light(const LightParams& light, bool display_referred,
                                   RegionPlan& plan);

void project_grade(const GradeParams& grade, const LayerParams& layer, RegionPlan& plan);
/// At draft quality there is no motion blur.
void project_finish(const FinishParams& finish, FlowQuality quality, RegionPlan& plan);
void project_lines(const LineParams& lines, RegionPlan& plan);

}  // namespace weft
