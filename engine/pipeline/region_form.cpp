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
    const float amount = region.form_amount * form.finding.belief;
    return Found(std::make_shared<LatticeForm>(std::move(form), amount));
}

}  // namespace weft
