#include "engine/pipeline/synthesis_inputs.h"

#include "engine/pipeline/plate_views.h"

namespace weft {

std::vector<ImageU8x3> synthesis_samples(const RegionPlan& region) {
    std::vector<ImageU8x3> out;
    out.push_back(make_views(region.texture->pixels, *region.display_from_texture).display);
    for (const ImageF3& further : region.texture->also)
        out.push_back(make_views(further, *region.display_from_texture).display);
    return out;
}

PlaneOptions plane_options(const RegionPlan& region, std::uint64_t seed, Size size,
                           const Backend* backend) {
    PlaneOptions options;
    options.size = size;
    options.seam = region.seam;
    options.overlap_px = region.overlap_px;
    options.feather_px = region.feather_px;
    options.seed = seed;
    options.region = region.random_key;
    options.backend = backend;
    options.seam_cost = region.seam_cost;
    options.refine_passes = region.refine_passes;
    options.orientations = region.orientations;
    options.align = region.align;
    options.mode = region.mode;
    return options;
}

Expected<TexturePlane> grow_texture(const RegionPlan& region, const PlaneOptions& options,
                                    const CancelToken& cancel, const ProgressFn& progress) {
    const std::vector<ImageU8x3> samples = synthesis_samples(region);
    return grow_plane({samples.begin(), samples.end()}, options, cancel, progress);
}

}  // namespace weft
