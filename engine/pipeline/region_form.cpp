#include "engine/pipeline/region_form.h"

#include <algorithm>
#include <string>

#include "engine/core/setting.h"
#include "engine/form/flatten.h"
#include "engine/form/lattice_form.h"
#include "engine/form/position_metric.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {
namespace {

// About a hundred cells across: finer than the folds that a texture can follow.
int spacing_of(Size plate) {
    constexpr int kCells = 108, kLeast_px = 4;
    return std::max(kLeast_px, (std::max(plate.width, plate.height) + kCells - 1) / kCells);
}

}  // namespace

Expected<std::shared_ptr<const SurfaceForm>> region_form(const ShotSource& source,
                                                         const ShotPlan& plan,
                                                         const AnalysisStore& store, int index) {
    using Found = Expected<std::shared_ptr<const SurfaceForm>>;
    const RegionPlan& region = plan.regions[static_cast<std::size_t>(index)];
    if (!region.has_positions || !(region.form_amount > 0)) return Found(nullptr);
    const int frame = region.reference_frames.front();
    WEFT_TRY(positions, source.positions(index, frame));
    WEFT_TRY(extent, extent_matte(source, plan, store, index, frame));
    WEFT_TRY(holdout, holdout_matte(source, plan, store, index, frame));
    MetricField field(positions.size(), spacing_of(positions.size()));
    add_positions(field, positions, without_holdout(extent, holdout));
    if (!field.finish()) {
        return fail(ErrorCode::kUnreadable,
                    "The position pass shows no form on frame " + std::to_string(frame) +
                        ": inside the matte its places are constant, on one line or not finite. "
                        "Choose the layer with the places of this surface" +
                        by({{setting::kPositionLayer}}) + ", or leave the pass out.");
    }
    return Found(std::make_shared<LatticeForm>(flat_from_reference(field), region.form_amount));
}

}  // namespace weft
