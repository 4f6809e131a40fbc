#include "engine/pipeline/synthesis_inputs.h"

#include "engine/pipeline/plate_views.h"

namespace weft {

ImageU8x3 synthesis_sample(const RegionPlan& region) {
    return make_views(region.texture->pixels, *region.display_from_texture).display;
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
    return options;
}

}  // namespace weft
