#pragma once
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_mattes.h"
#include "engine/pipeline/sweep.h"

namespace weft {

/// Turns the light samples of a region (AnalysisKind::kLightSample, with kCoords, of every frame of
/// `span`) into shadings. The frames of RegionPlan::light_evidence show what is paint. Errors:
/// cancellation, and those of the store.
[[nodiscard]] Status estimate_light(const PassContext& context, int region, FrameSpan span,
                                    AnalysisStore& store);

}  // namespace weft
