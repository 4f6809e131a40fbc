#pragma once
#include "engine/form/form_map.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/form_motion.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// The form of a region that `frames` show together, the reference frame first: from its position
/// or normal pass on them, the others counting where they see the surface more squarely or alone,
/// or from its motion between them. Needs mattes and kCoords of these frames. Errors: those of the
/// source and the store; Unreadable if the pass shows no form there, or normals in other axes;
/// cancellation. `lens`: what other regions say of it.
[[nodiscard]] Expected<FormMap> form_from(const PassContext& context, const AnalysisStore& store,
                                          int region, const std::vector<int>& frames,
                                          const MotionLens& lens = {});

/// Stores the form (kForm) of every region that has one and whose form is not in the store, from
/// RegionPlan::form_evidence. Needs the mattes, and follow_surfaces() before. Errors: as
/// form_from().
[[nodiscard]] Status find_forms(const PassContext& context, AnalysisStore& store);

/// Whether a region's form is still to be found, and how many are.
[[nodiscard]] bool lacks_form(const ShotPlan& plan, const AnalysisStore& store, int region);
[[nodiscard]] int count_form_steps(const ShotPlan& plan, const AnalysisStore& store);

}  // namespace weft
