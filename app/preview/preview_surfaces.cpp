// What the analysis says of the regions' surfaces: their form, and where a frame lies on them.
#include <cctype>

#include "app/preview/preview_impl.h"
#include "app/render/form_report.h"
#include "app/render/light_report.h"
#include "engine/form/plane_corners.h"
#include "engine/pipeline/motion_zones.h"
#include "engine/pipeline/region_form.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {

void Preview::Impl::note_forms() {
    if (noted_forms == current->pixels) return;
    const Shot& shot = *current->shot;
    std::map<RegionId, std::string> found;
    const auto reports = form_reports(shot, *current->store);
    if (!reports) return;  // whatever needs the store next says what is wrong with it
    for (const FormReport& form : *reports) {
        for (const std::size_t k : shot.region_index) {
            const Region& region = *shot.project.regions[k];
            if (region.name != form.region) continue;
            std::string& text = found[region.id] = form_text(form);
            text.front() =
                static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
        }
    }
    std::map<RegionId, Quad<float>> planes = found_planes();
    noted_forms = current->pixels;
    const auto shared = guarded.lock();
    shared->shown.forms = std::move(found);
    shared->shown.planes = std::move(planes);
    changed(*shared);
}

void Preview::Impl::note_lights(int frame) {
    const Shot& shot = *current->shot;
    const auto reports = light_reports(shot, *current->store, {frame});
    if (!reports) return;  // as above
    std::map<RegionId, std::string> found;
    for (const LightReport& light : *reports) {
        const auto text = unsure_light_text(light);
        for (const std::size_t k : shot.region_index) {
            const Region& region = *shot.project.regions[k];
            if (text && region.name == light.region) found[region.id] = *text;
        }
    }
    const auto shared = guarded.lock();
    if (shared->shown.lights == found) return;
    shared->shown.lights = std::move(found);
    changed(*shared);
}

std::map<RegionId, Quad<float>> Preview::Impl::found_planes() const {
    std::map<RegionId, Quad<float>> out;
    const Shot& shot = *current->shot;
    for (std::size_t k = 0; k < shot.plan.regions.size(); ++k) {
        const int index = static_cast<int>(k),
                  frame = shot.plan.regions[k].reference_frames.front();
        if (!current->store->has({index, frame, AnalysisKind::kForm})) continue;
        const auto form = found_form(shot.plan.regions[k], *current->store, index);
        if (!form || !*form) continue;
        const auto matte = extent_matte(*shot.source, shot.plan, *current->store, index, frame);
        if (!matte) continue;
        auto corners = plane_corners(**form, *matte);
        if (!corners) continue;
        // Corners replace a form from motion; any other one stays beneath them.
        const RegionPlan& plan = shot.plan.regions[k];
        if (plan.form_from != RegionPlan::FormFrom::kMotion)
            for (Vec2& corner : *corners) {
                const PixelAspect aspect = (*form)->aspect;
                const Vec2 moved = plan.form_amount_at(plan.reference_frames.front()) *
                                   (*form)->finding.laid_share() *
                                   (*form)->at(aspect.unsqueezed(corner));
                corner += aspect.squeezed(moved);
            }
        out[shot.project.regions[shot.region_index[k]]->id] = *corners;
    }
    return out;
}

std::map<RegionId, std::shared_ptr<const SurfacePlaces>> Preview::Impl::places_on(int frame) {
    std::map<RegionId, std::shared_ptr<const SurfacePlaces>> out;
    const Shot& shot = *current->shot;
    const ZonedAnalysis placed(*shot.source, shot.plan, *current->store);
    for (std::size_t k = 0; k < scenes.scenes().size(); ++k) {
        const RegionPlan& plan = shot.plan.regions[k];
        if (plan.temporal != TemporalMode::kLocked || plan.has_uv) continue;
        const auto bytes = placed.get({static_cast<int>(k), frame, AnalysisKind::kCoords});
        if (!bytes) continue;
        auto ref_from_cur = decode_lattice(*bytes);
        PlanePlacement bare = plan.placement_at(frame);
        bare.scale = 1;
        bare.rotate_deg = 0;
        bare.offset_px = {0, 0};
        const auto ground = texture_mapping(bare);
        if (!ref_from_cur || !ground) continue;
        out[shot.project.regions[shot.region_index[k]]->id] = std::make_shared<const SurfacePlaces>(
            std::move(*ref_from_cur),
            ground->with_form(form_on(plan, scenes.scenes()[k].mapping.form(), frame)));
    }
    return out;
}

}  // namespace weft
