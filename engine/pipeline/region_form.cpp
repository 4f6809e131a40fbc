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
    return Laid(std::make_shared<LatticeForm>(*found, region.form_amount * found->finding.belief));
}

Expected<ShownForm> region_form_on(const RegionScene& scene, const AnalysisStore& store, int index,
                                   int frame, ViewU8x1 matte, const Recti& box) {
    if (!scene.form)
        return ShownForm{ImageF3(box.size()), ImageF1(box.size()), ImageF1(box.size())};
    WEFT_TRY(bytes, store.get({index, frame, AnalysisKind::kCoords}));
    WEFT_TRY(ref_from_cur, decode_lattice(bytes));
    return form_on_frame(*scene.form, ref_from_cur, matte, box, scene.smaller);
}

}  // namespace weft
