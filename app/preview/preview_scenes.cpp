#include "app/preview/preview_scenes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/shot/form_files.h"
#include "engine/core/hash.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {

namespace {

std::string amendments_text(const std::vector<PlaneAmendment>& amendments) {
    Hasher hasher;
    for (const PlaneAmendment& amendment : amendments) {
        hasher.value(static_cast<int>(amendment.kind)).value(amendment.seed);
        for (const TexelRun& run : amendment.runs) {
            hasher.value(run.x).value(run.y).value(run.count).value(run.from_x).value(run.from_y);
            hasher.value(run.sample).value(run.orientation);
        }
    }
    return hasher.finish().hex();
}

// The part of the plate, at most `shown`, whose plane has about this many texels.
Size part_to_grow(const PlanePlacement& placement, Size shown, std::int64_t texels) {
    const Size plane = plane_size(placement, shown);
    const double all = static_cast<double>(plane.width) * plane.height;
    const double share = std::min(1.0, std::sqrt(static_cast<double>(texels) / all));
    return {static_cast<int>(share * shown.width), static_cast<int>(share * shown.height)};
}

}  // namespace

std::vector<PreviewScenes::Keys> PreviewScenes::keys_of(const Shot& shot,
                                                        const std::string& analysis) {
    std::vector<Keys> keys;
    for (std::size_t k = 0; k < shot.plan.regions.size(); ++k) {
        const RegionPlan& plan = shot.plan.regions[k];
        const Region& region = *shot.project.regions[shot.region_index[k]];
        Hasher hasher;  // first what the plane depends on, then the light
        for (const ShotTexture& further : shot.textures[k].also)
            hasher.text(further.id);
        hasher.text(shot.textures[k].id).text(shot.spaces.textures[k].name);
        hasher.text(shot.spaces.working.name);
        hasher.value(plan.random_key).value(shot.plan.seed).value(static_cast<int>(plan.temporal));
        hasher.value(static_cast<int>(plan.seam)).value(plan.overlap_px).value(plan.feather_px);
        hasher.value(static_cast<int>(plan.seam_cost)).value(plan.refine_passes).value(plan.align);
        hasher.value(plan.orientations.rotations).value(plan.orientations.mirror);
        hasher.text(amendments_text(plan.amendments));
        hasher.value(static_cast<int>(region.texture.wrap)).value(plan.texture->is_plane);
        hasher.value(static_cast<int>(region.texture.mode));
        const Size size = plane_size(plan.placement, shot.source->size());
        const std::string size_key = plan.texture->is_plane ? std::string()
                                                            : " " + std::to_string(size.width) +
                                                                  "x" + std::to_string(size.height);
        Keys key;
        key.plane = hasher.finish().hex() + size_key;
        // The analysis determines the light to which the scene is relative.
        hasher.text(analysis).value(static_cast<int>(plan.light_source)).text(region.light.image);
        hasher.value(plan.light.strength > 0);
        add_form_settings(hasher.value(plan.form_amount).value(plan.form_amount_keys.empty()),
                          region);
        key.texture = hasher.finish().hex();
        // Seams between tracks depend on the texture's position.
        Hasher placed;
        if (plan.reference_frames.size() > 1) {
            const PlanePlacement& p = plan.placement;
            placed.value(p.scale).value(p.rotate_deg).value(p.offset_px.x).value(p.offset_px.y);
            for (const Vec2 c : p.corners.value_or(std::array<Vec2, 4>{}))
                placed.value(c.x).value(c.y);
            if (plan.warp) placed.text(grid_warp_text(*plan.warp));
        }
        key.exact = placed.finish().hex() + key.texture + size_key;
        keys.push_back(std::move(key));
    }
    return keys;
}

bool PreviewScenes::adopt(const Shot& shot, const std::string& analysis) {
    const std::vector<Keys> wanted = keys_of(shot, analysis);
    for (std::size_t k = 0; k < keys_.size(); ++k)
        if (!keys_[k].exact.empty()) bank_.push_front({keys_[k], std::move(scenes_[k])});
    scenes_.clear();
    scenes_.resize(wanted.size());
    keys_.assign(wanted.size(), {});
    // Exact matches first, then planes of other sizes.
    for (const bool by_texture : {false, true}) {
        for (std::size_t k = 0; k < wanted.size(); ++k) {
            if (!keys_[k].exact.empty()) continue;
            const auto found = std::find_if(bank_.begin(), bank_.end(), [&](const Kept& kept) {
                return by_texture ? kept.keys.texture == wanted[k].texture
                                  : kept.keys.exact == wanted[k].exact;
            });
            if (found == bank_.end()) continue;
            scenes_[k] = std::move(found->scene);
            keys_[k] = found->keys;
            bank_.erase(found);
        }
    }
    trim();
    exact_ = keys_ == wanted;
    bool usable = true;
    for (std::size_t k = 0; k < scenes_.size(); ++k) {
        if (keys_[k].exact.empty()) {
            usable = false;
            continue;
        }
        if (auto mapping = texture_mapping(shot.plan.regions[k].placement))
            scenes_[k].mapping = mapping->on_surface_of(scenes_[k].mapping);
    }
    return usable;
}

void PreviewScenes::trim() {
    std::size_t bytes = 0;
    for (auto kept = bank_.begin(); kept != bank_.end();) {
        for (const PlanePyramid::Level& level : kept->scene.plane.levels())
            bytes += level.size_bytes();
        kept = bytes > kBankBytes ? bank_.erase(kept) : std::next(kept);
    }
}

Status PreviewScenes::grow_one(const Shot& shot, const AnalysisStore& store,
                               const std::string& analysis, const CancelToken& cancel) {
    const std::vector<Keys> wanted = keys_of(shot, analysis);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        if (keys_[k] == wanted[k]) continue;
        // The seam layer needs the seams.
        ShotPlan plan = shot.plan;
        plan.layers = true;
        // Very large maps are not kept; the plane is synthesized again if the source map is
        // requested.
        constexpr std::int64_t kMostTexels = 6'000'000;
        const Size size = plane_size(plan.regions[k].placement, shot.source->size());
        plan.keep_planes = std::int64_t{size.width} * size.height <= kMostTexels;
        auto scene = make_scene(*shot.source, plan, store, static_cast<int>(k), cancel, {}, nullptr,
                                kept_plane(wanted[k].plane));
        if (!scene) {
            const Region& region = *shot.project.regions[shot.region_index[k]];
            return fail_in(std::move(scene).error(),
                           "Region '" + region.name + "' with " + shot.textures[k].path);
        }
        scenes_[k] = std::move(*scene);
        keys_[k] = wanted[k];
        break;
    }
    exact_ = keys_ == wanted;
    return {};
}

std::optional<RegionPlane> PreviewScenes::kept_plane(const std::string& plane_key) const {
    const auto plane_of = [](const RegionScene& scene) {
        return RegionPlane{scene.plane, scene.stats, scene.plane_seams, scene.grown};
    };
    for (std::size_t k = 0; k < keys_.size(); ++k)
        if (keys_[k].plane == plane_key && !scenes_[k].plane.empty()) return plane_of(scenes_[k]);
    for (const Kept& kept : bank_)
        if (kept.keys.plane == plane_key && !kept.scene.plane.empty()) return plane_of(kept.scene);
    return std::nullopt;
}

Expected<RegionPlane> PreviewScenes::quick_plane(const ShotPlan& plan, std::size_t index,
                                                 const std::string& plane_key, Size shown,
                                                 const CancelToken& cancel) {
    RegionPlan region = plan.regions[index];
    region.refine_passes = 0;
    if (region.seam == SeamMethod::kGraphCut) region.seam = SeamMethod::kDynamicProgramming;
    region.amendments.clear();  // they refer to the whole plane
    const Size size = plane_size(region.placement, shown);
    const std::string key =
        plane_key + " " + std::to_string(size.width) + "x" + std::to_string(size.height);
    for (const KeptPlane& kept : quick_bank_)
        if (kept.key == key) return kept.plane;
    WEFT_TRY(plane, make_plane(plan, region, shown, cancel, {}));
    constexpr std::size_t kMost = 8;
    quick_bank_.push_front({key, plane});
    if (quick_bank_.size() > kMost) quick_bank_.pop_back();
    return plane;
}

Expected<std::vector<RegionScene>> PreviewScenes::quick(const Shot& shot, const ShotPlan& plan,
                                                        const AnalysisStore& store, int frame,
                                                        const std::vector<bool>& shown,
                                                        std::int64_t texels,
                                                        const CancelToken& cancel) {
    const std::vector<Keys> wanted = keys_of(shot, {});
    std::vector<RegionScene> out(plan.regions.size());
    ShotPlan with_seams = plan;
    with_seams.layers = true;
    for (std::size_t k = 0; k < out.size(); ++k) {
        if (!shown[k]) continue;
        const int index = static_cast<int>(k);
        std::optional<RegionPlane> plane = kept_plane(wanted[k].plane);
        if (!plane && has_plane(plan.regions[k])) {
            WEFT_TRY(matte, shown_matte(*shot.source, plan, store, index, frame));
            const Size part =
                part_to_grow(plan.regions[k].placement, matte_bounds(matte).size(), texels);
            WEFT_TRY(grown, quick_plane(with_seams, k, wanted[k].plane, part, cancel));
            plane = std::move(grown);
        }
        WEFT_TRY(scene, make_scene(*shot.source, with_seams, store, index, cancel, {}, nullptr,
                                   std::move(plane)));
        out[k] = std::move(scene);
    }
    return out;
}

}  // namespace weft
