#include "engine/pipeline/surface_light.h"

#include <utility>

namespace weft {

SurfaceSample SurfaceLight::measure(ViewF3 working, ViewU8x1 visible, ShadingOptions options,
                                    int frame, int primary) {
    if (!daylight_) daylight_ = find_daylight(working);
    if (frame < primary && !std::exchange(went_back_, true)) daylight_->before = at_primary_;
    options.daylight = daylight_;
    options.print = print_;
    SurfaceSample sample = light_sample(working, visible, options);
    if (!print_ && !sample.box.empty()) print_ = sample.print;
    daylight_->before = sample.evidence;
    if (frame == primary) at_primary_ = sample.evidence;
    return sample;
}

}  // namespace weft
