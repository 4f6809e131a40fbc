#pragma once
// Zones: parts of a region in which a setting has another value, painted on a few frames and
// propagated like mattes.

#include "engine/lighting/shading.h"
#include "engine/pipeline/analysis_store.h"
#include "engine/pipeline/region_plan.h"
#include "engine/pipeline/shot_source.h"

namespace weft {

/// A zone's matte on a frame, with its edge tools: from its files, or as it was propagated (which
/// must be done).
[[nodiscard]] Expected<Matte> zone_matte(const ShotSource& source, const ShotPlan& plan,
                                         const AnalysisStore& store, int region, int zone,
                                         int frame);

/// The same without its edge tools, as the analysis follows it.
[[nodiscard]] Expected<Matte> bare_zone_matte(const ShotSource& source, const ShotPlan& plan,
                                              const AnalysisStore& store, int region, int zone,
                                              int frame);

/// The factor that a region's zones of one kind put on a setting, for each pixel of the plate: the
/// product over the zones of 1 + m (v − 1), m the zone's matte (0 to 1) and v its value on this
/// frame. Empty where the region has no such zone. Errors: those of zone_matte().
[[nodiscard]] Expected<ImageF1> zone_factor(const ShotSource& source, const ShotPlan& plan,
                                            const AnalysisStore& store, int region, ZoneKind kind,
                                            int frame);

/// Light detail for each pixel of the plate: the region's own, replaced inside its zones of that
/// kind (m of a zone's value, 1 − m of what is below it). Empty where it is kEstimatedDetail
/// throughout. Errors: those of zone_matte().
[[nodiscard]] Expected<ImageF1> light_detail(const ShotSource& source, const ShotPlan& plan,
                                             const AnalysisStore& store, int region, int frame);

/// Scales how far the shading departs from `reference` (S₀, > 0): S ← S₀ + k (S − S₀), k the mean
/// of `factor` (H×W, of the plate) over each of the shading's blocks. The result stays above 0.
void scale_light(Shading& shading, float reference, ViewF1 factor);

}  // namespace weft
