#include "engine/pipeline/stage_store.h"

namespace weft {
namespace {

// Raise this whenever the pixels of grown planes change.
constexpr int kPlaneVersion = 4;

}  // namespace

Hash128 plane_key(const std::vector<ImageU8x3>& samples, const PlaneOptions& options) {
    Hasher hasher;
    hasher.value(kPlaneVersion);
    for (const ImageU8x3& sample : samples)
        hasher.image(sample);
    hasher.value(options.size.width).value(options.size.height);
    hasher.value(static_cast<int>(options.seam)).value(static_cast<int>(options.seam_cost));
    hasher.value(options.overlap_px).value(options.feather_px).value(options.seed);
    hasher.value(options.region).value(options.frame).value(options.tileable);
    hasher.value(options.refine_passes).value(options.align);
    hasher.value(static_cast<int>(options.mode)).value(options.whole_periods);
    hasher.value(options.orientations.rotations).value(options.orientations.mirror);
    for (const PlaneAmendment& amendment : options.amendments) {
        hasher.value(static_cast<int>(amendment.kind)).value(amendment.seed);
        hasher.value(static_cast<std::uint64_t>(amendment.runs.size()));
        for (const TexelRun& run : amendment.runs)
            hasher.value(run.x)
                .value(run.y)
                .value(run.count)
                .value(run.from_x)
                .value(run.from_y)
                .value(run.sample)
                .value(run.orientation);
    }
    return hasher.finish();
}

}  // namespace weft
