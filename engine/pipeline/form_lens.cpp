#include "engine/pipeline/form_lens.h"

#include <algorithm>

namespace weft {

Expected<MotionLens> shared_lens(const PassContext& context, const AnalysisStore& store) {
    const std::vector<RegionPlan>& regions = context.plan.regions;
    MotionLens out;
    const auto shares = [](const RegionPlan& region) { return region.shares_lens(); };
    if (std::count_if(regions.begin(), regions.end(), shares) < 2) return out;
    std::vector<TangentBelief> measured;
    for (std::size_t k = 0; k < regions.size(); ++k) {
        if (!shares(regions[k])) continue;
        WEFT_TRY(evidence,
                 form_evidence_on(context, store, static_cast<int>(k), regions[k].form_evidence));
        const auto fit = fit_motion(evidence, evidence.front().visible.size(), {});
        if (!fit) continue;
        if (const auto tangent = fit->measured_tangent()) measured.push_back(*tangent);
    }
    out.shared = shared_tangent(measured);
    out.regions = static_cast<int>(measured.size());
    return out;
}

}  // namespace weft
