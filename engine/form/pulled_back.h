#pragma once
#include <optional>

#include "engine/form/metric_field.h"
#include "engine/motion/lattice_field.h"

namespace weft {

/// A frame's metric at one of its places, as a step on the reference frame sees it: M⁻ᵀ G M⁻¹ with
/// M = ∂(x + ref_from_cur)/∂x. Empty where the motion folds or stretches beyond belief.
[[nodiscard]] std::optional<Metric> pulled_back(const Metric& g, const LatticeField& ref_from_cur,
                                                Vec2 at);

}  // namespace weft
