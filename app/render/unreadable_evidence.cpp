#include "app/render/unreadable_evidence.h"

#include <set>

#include "engine/pipeline/focus_frames.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {

std::vector<int> unreadable_evidence(const Shot& shot) {
    std::set<int> out;
    for (std::size_t k = 0; k < shot.plan.regions.size(); ++k) {
        const RegionPlan& region = shot.plan.regions[k];
        RegionPlan needed = region;
        needed.light_evidence.clear();
        needed.gloss_evidence.clear();
        needed.grain_frames.clear();
        needed.shutter_evidence.clear();
        needed.form_evidence.clear();
        needed.focus_frames.clear();
        needed.calm_span = {};
        const FrameSpan without = analysed_span(shot.plan, needed);
        const FrameSpan with = analysed_span(shot.plan, region);
        const auto look = [&](int frame) {
            if (frame >= without.first && frame <= without.last) return;
            const bool has_matte =
                region.propagated() || shot.source->matte(static_cast<int>(k), frame).has_value();
            if (!has_matte || !shot.source->plate(frame)) out.insert(frame);
        };
        for (int frame = with.first; frame <= with.last; ++frame)
            look(frame);
        for (const int frame : needed_focus_frames(shot.plan, region))
            look(frame);
    }
    return {out.begin(), out.end()};
}

}  // namespace weft
