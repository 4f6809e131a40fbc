#include "engine/synthesis/grow_canvas.h"

#include "engine/core/stopwatch.h"
#include "engine/synthesis/device_search.h"
#include "engine/synthesis/plane_energy.h"
#include "engine/synthesis/refine.h"
#include "engine/synthesis/sweep.h"

namespace weft {
namespace {

// The baselines are not refined, nor is a guided plane, which is synthesized for each frame to
// match its guide.
bool refines(const PlaneOptions& o) {
    return o.refine_passes > 0 && o.seam == SeamMethod::kGraphCut &&
           o.seam_cost == SeamCost::kGradient && !o.guide;
}

}  // namespace

bool grow_canvas(const SampleAtlas& atlas, const PlaneOptions& options,
                 const PlaneStructure& structure, Canvas& canvas, PlaneStats& stats,
                 const CancelToken& cancel, const ProgressFn& progress) {
    std::optional<Canvas> again;
    if (refines(options)) {
        canvas.any_locked() ? again.emplace(canvas) : again.emplace(canvas.size(), canvas.torus());
    }
    DeviceSearch device(atlas, options, canvas);
    Sweep sweep(atlas, options, structure, canvas, device);
    if (!sweep.run(stats, cancel, progress)) return false;
    if (!again) return true;

    const ScopeTimer timer(stats.refine_s);
    if (!sweep.cut_again(*again, kRefineGradientFloor, stats, cancel)) return false;
    if (recount_energy(atlas, again->source(), canvas.torus()).energy <
        recount_energy(atlas, canvas.source(), canvas.torus()).energy) {
        canvas = std::move(*again);
        device.show(canvas, rect_of(canvas.size()));
    }
    again.reset();
    Refiner refiner(atlas, options, sweep.lattice(), canvas, device);
    for (int pass = 1; pass < options.refine_passes; ++pass) {
        if (cancel.cancelled()) return false;
        if (refiner.pass(pass, stats) <= 0) break;
    }
    return true;
}

}  // namespace weft
