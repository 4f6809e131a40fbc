#include "engine/pipeline/region_form.h"

#include "engine/form/lattice_form.h"

namespace weft {

Expected<std::shared_ptr<const SurfaceForm>> region_form(const RegionPlan& region,
                                                         const AnalysisStore& store, int index) {
    using Found = Expected<std::shared_ptr<const SurfaceForm>>;
    if (!region.has_form()) return Found(nullptr);
    WEFT_TRY(bytes, store.get({index, region.reference_frames.front(), AnalysisKind::kForm}));
    WEFT_TRY(form, decode_form(bytes));
    if (form.finding.source == FormFinding::Source::kNone) return Found(nullptr);
    // With keys the frame says how much of it (mapping_on()).
    const float amount =
        (region.form_amount_keys.empty() ? region.form_amount : 1.0f) * form.finding.belief;
    return Found(std::make_shared<LatticeForm>(std::move(form), amount));
}

std::shared_ptr<const SurfaceForm> form_on(const RegionPlan& region,
                                           const std::shared_ptr<const SurfaceForm>& whole,
                                           int frame) {
    if (!whole || region.form_amount_keys.empty()) return whole;
    return whole->at_share(region.form_amount_at(frame));
}

}  // namespace weft
