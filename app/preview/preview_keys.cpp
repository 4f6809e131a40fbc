#include <algorithm>

#include "app/preview/preview.h"
#include "app/project/codec/project_json.h"

namespace weft {
namespace {

std::string text_of(const Project& project) {
    const auto json = project_to_json(project);
    return json ? *json : json.error().text();
}

Project only_pixels(const Project& project) {
    Project p = project;
    p.name.clear();
    p.extra.clear();
    p.output = Output{};
    p.next_region_id = 1;
    p.plate.fps = 0;
    std::erase_if(p.regions, [](const Leaf<Region>& region) { return !region->enabled; });
    for (Leaf<Region>& region : p.regions) {
        region = region.with([](Region& r) {
            r.name.clear();
            r.color = 0;
            r.extra.clear();
        });
    }
    return p;
}

// The analysis follows mattes without their edge tools.
void forget_edges(Region& region) {
    const auto forget = [](MatteSource& matte) { matte.edge = {}; };
    region.matte = region.matte.with(forget);
    region.holdouts = region.holdouts.with([&](std::vector<MatteSource>& holdouts) {
        std::for_each(holdouts.begin(), holdouts.end(), forget);
    });
    region.zones = region.zones.with([&](std::vector<Zone>& zones) {
        for (Zone& zone : zones)
            forget(zone.matte);
    });
}

}  // namespace

std::string pixel_key(const Project& project) {
    return text_of(only_pixels(project));
}

std::string analysis_key(const Project& project) {
    Project p = only_pixels(project);
    for (Leaf<Region>& region : p.regions) {
        region = region.with(forget_edges);
        if (region->temporal.mode == TemporalMode::kPaper) continue;
        region = region.with([](Region& r) {
            r.texture = TextureSource{};
            r.placement = Placement{};
            r.synthesis = SynthesisParams{};
            r.amendments = {};
            TemporalParams temporal;
            temporal.mode = r.temporal.mode;
            r.temporal = temporal;
            r.light.image.clear();
            r.light.form = LightForm::kGain;
            r.light.strength = r.light.strength > 0 ? 1 : 0;
        });
    }
    return text_of(p);
}

std::string strip_key(const CardRequest& request) {
    return std::to_string(request.frame) + " " + std::to_string(request.around) + " " +
           pixel_key(request.project);
}

}  // namespace weft
