#include "engine/pipeline/partial_plan.h"

namespace weft {

void leave_camera_out(RegionPlan& region) {
    region.grain = 0;
    region.grain_frames.clear();
    region.focus = 0;
    region.focus_frames.clear();
    region.shutter_deg = 0;
    region.shutter_evidence.clear();
}

void leave_look_out(RegionPlan& region) {
    region.zones.clear();
    region.light_source = LightSource::kNone;
    region.light_frame.reset();
    region.light_evidence.clear();
    region.gloss_evidence.clear();
    leave_camera_out(region);
}

void leave_region_out(RegionPlan& region) {
    region.temporal = TemporalMode::kNone;
    region.matte_keys.clear();
    region.matte_confirmed.clear();
    region.painted_holdouts.clear();
}

}  // namespace weft
