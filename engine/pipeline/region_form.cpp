#include "engine/pipeline/region_form.h"

#include "engine/form/lattice_form.h"

namespace weft {

Expected<std::shared_ptr<const FormMap>> found_form(const RegionPlan& region,
                                                    const AnalysisStore& store, int index) {
    using Found = Expected<std::shared_ptr<const FormMap>>;
    if (!region.has_form()) return Found(nullptr);
    WEFT_TRY(bytes, store.get({index, region.reference_frames.front(), AnalysisKind::kForm}));
    WEFT_TRY(form, decode_form(bytes));
    if (form.finding.source == FormFinding::Source::kNone) return Found(nullptr);
    return Found(std::make_shared<const FormMap>(std::move(form)));
}

Expected<std::shared_ptr<const SurfaceForm>> region_form(const RegionPlan& region,
                                                         const AnalysisStore& store, int index) {
    using Laid = Expected<std::shared_ptr<const SurfaceForm>>;
    WEFT_TRY(found, found_form(region, store, index));
    if (!found) return Laid(nullptr);
    // With keys the frame says how much of it (mapping_on()).
    const float amount = region.form_amount_keys.empty() ? region.form_amount : 1.0f;
    return Laid(std::make_shared<LatticeForm>(*found, amount * found->finding.laid_share()));
}

Expected<ShownForm> region_form_on(const RegionScene& scene, const AnalysisStore& store, int index,
                                   int frame, ViewU8x1 matte, const Recti& box) {
    if (!scene.form)
        return ShownForm{ImageF3(box.size()), ImageF1(box.size()), ImageF1(box.size())};
    WEFT_TRY(bytes, store.get({index, frame, AnalysisKind::kCoords}));
    WEFT_TRY(ref_from_cur, decode_lattice(bytes));
    return form_on_frame(*scene.form, ref_from_cur, matte, box, scene.smaller);
}

std::shared_ptr<const SurfaceForm> form_on(const RegionPlan& region,
                                           const std::shared_ptr<const SurfaceForm>& whole,
                                           int frame) {
    if (!whole || region.form_amount_keys.empty()) return whole;
    return whole->at_share(region.form_amount_at(frame));
}

}  // namespace weft
