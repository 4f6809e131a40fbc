#include "app/session/measure_report.h"

#include <nlohmann/json.hpp>

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& v) {
    return v ? Json(*v) : Json();
}

Json spread(const Spread& s) {
    if (s.frames == 0) return Json();
    return {{"mean", s.mean}, {"least", s.least}, {"largest", s.largest}};
}

Json frame_json(const FrameMeasures& f) {
    return {{"frame", f.frame},
            {"tde", number(f.tde)},
            {"source_tde", number(f.source_tde)},
            {"tde_floor", number(f.tde_floor)},
            {"tde_at_floor", number(f.tde_at_floor)},
            {"sharpness_kept", number(f.sharpness_kept)},
            {"rms_contrast_kept", number(f.rms_contrast_kept)},
            {"mean_v", number(f.mean_v)},
            {"source_mean_v", number(f.source_mean_v)},
            {"region_px", f.region_pixels},
            {"outside_differing_px", f.outside_differing},
            {"outside_max", f.outside_max}};
}

}  // namespace

Json measure_json(const MeasuredResult& o) {
    const SequenceMeasures& a = o.all;
    Json frames = Json::array();
    for (const FrameMeasures& f : o.frames)
        frames.push_back(frame_json(f));
    return {{"motion", a.motion},
            {"frames", a.frames},
            {"tde", spread(a.tde)},
            {"source_tde", spread(a.source_tde)},
            {"tde_floor", spread(a.tde_floor)},
            {"tde_at_floor", spread(a.tde_at_floor)},
            {"tde_over_floor", number(a.tde_over_floor)},
            {"sharpness_kept", spread(a.sharpness_kept)},
            {"rms_contrast_kept", spread(a.rms_contrast_kept)},
            {"drift_px", a.drift ? Json(a.drift->mean_px) : Json()},
            {"tiv", a.tiv},
            {"source_tiv", a.source_tiv},
            {"tiv_relative", a.tiv_relative},
            {"outside_differing_px", a.outside_differing},
            {"outside_max", a.outside_max},
            {"per_frame", std::move(frames)}};
}

}  // namespace weft
