#include "app/session/mattes/form_check.h"

#include <utility>

#include "app/shot/form_files.h"
#include "engine/core/unsqueezed_image.h"
#include "engine/form/drawn_form.h"

namespace weft {

MattePtr FormCheck::matte_on_reference(const Region& region) {
    const auto& chosen = use_.preview.reading().view.references;
    const auto found = chosen.find(region.id);
    std::optional<int> frame;
    if (!region.reference_frames.empty())
        frame = region.reference_frames.front();
    else if (found != chosen.end())
        frame = found->second;
    return frame ? use_.shown.base_of(region, 0, *frame).matte : nullptr;
}

std::string FormCheck::problem(const Region& region) {
    const bool used = region.form.amount > 0 || !region.form.amount_keys.empty();
    if (!use_.plate.reader() || !used || form_files(region).from != RegionPlan::FormFrom::kShape)
        return {};
    const MattePtr matte = matte_on_reference(region);
    if (!matte) return {};
    std::vector<FormGuide> guides = region.form.shape;
    guides.insert(guides.end(), region.form.strokes.begin(), region.form.strokes.end());
    const PixelAspect aspect = use_.plate.aspect();
    Checked& known = checked_[region.id];
    if (known.matte == matte && known.guides == guides && known.fov_deg == region.form.fov_deg &&
        known.aspect == aspect)
        return known.problem;
    known = {guides, region.form.fov_deg, aspect, matte, {}};
    for (FormGuide& guide : guides)
        guide = unsqueezed(std::move(guide), aspect);
    const Matte seen = unsqueezed(*matte, aspect);
    const Status usable = check_drawn_form(guides, {seen.size(), known.fov_deg}, seen);
    if (!usable) known.problem = usable.error().sentence();
    return known.problem;
}

void FormCheck::show(SessionView& view) {
    view.form_problems.clear();
    if (!use_.document.is_open()) return;
    for (const Leaf<Region>& region : use_.document.project().regions) {
        std::string what = region->enabled ? problem(*region) : std::string();
        if (!what.empty()) view.form_problems[region->id] = std::move(what);
    }
}

}  // namespace weft
