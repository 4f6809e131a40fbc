#include "app/preview/preview_scenes.h"

#include <algorithm>
#include <iterator>

#include "engine/core/hash.h"

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

}  // namespace

std::vector<PreviewScenes::Keys> PreviewScenes::keys_of(const Shot& shot,
                                                        const std::string& analysis) {
    std::vector<Keys> keys;
    for (std::size_t k = 0; k < shot.plan.regions.size(); ++k) {
        const RegionPlan& plan = shot.plan.regions[k];
        const Region& region = *shot.project.regions[shot.region_index[k]];
        Hasher hasher;
        for (const ShotTexture& further : shot.textures[k].also)
            hasher.text(further.id);
        hasher.text(shot.textures[k].id).text(shot.spaces.textures[k].name);
        hasher.value(plan.random_key).value(shot.plan.seed).value(static_cast<int>(plan.temporal));
        hasher.value(static_cast<int>(plan.seam)).value(plan.overlap_px).value(plan.feather_px);
        hasher.value(static_cast<int>(plan.seam_cost)).value(plan.refine_passes).value(plan.align);
        hasher.value(plan.orientations.rotations).value(plan.orientations.mirror);
        hasher.text(amendments_text(plan.amendments));
        hasher.value(static_cast<int>(region.texture.wrap)).value(plan.texture->is_plane);
        // The analysis determines the light to which the scene is relative.
        hasher.text(analysis).value(static_cast<int>(plan.light_source)).text(region.light.image);
        hasher.value(plan.light.strength > 0);
        Keys key;
        key.texture = hasher.finish().hex();
        const Size size = plane_size(plan.placement, shot.source->size());
        // Seams between tracks depend on the texture's position.
        Hasher placed;
        if (plan.reference_frames.size() > 1) {
            const PlanePlacement& p = plan.placement;
            placed.value(p.scale).value(p.rotate_deg).value(p.offset_px.x).value(p.offset_px.y);
            for (const Vec2 c : p.corners.value_or(std::array<Vec2, 4>{}))
                placed.value(c.x).value(c.y);
        }
        key.exact = placed.finish().hex() + key.texture +
                    (plan.texture->is_plane
                         ? std::string()
                         : " " + std::to_string(size.width) + "x" + std::to_string(size.height));
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
            scenes_[k].mapping = *mapping;
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
        auto scene = make_scene(*shot.source, plan, store, static_cast<int>(k), cancel, {});
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

}  // namespace weft
