#include "app/measure/measure_report.h"

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

Json steps_json(const std::optional<PopSteps>& steps) {
    if (!steps) return Json();
    Json out = Json::object();
    for (std::size_t k = 0; k < kPopKinds; ++k) {
        const auto kind = static_cast<PopKind>(k);
        const auto& step = steps->of(kind);
        out[name_of(kind)] = step ? Json(step->beyond) : Json();
    }
    return out;
}

Json pops_json(const Pops& pops) {
    Json out = Json::object();
    out["frames"] = pops.frames();
    for (std::size_t k = 0; k < kPopKinds; ++k) {
        const auto kind = static_cast<PopKind>(k);
        const PopsOfKind& p = pops.of(kind);
        out[name_of(kind)] = {{"largest", p.largest},
                              {"frame", p.deviation > 0 ? Json(p.frame) : Json()},
                              {"deviation", p.deviation},
                              {"frames", p.frames}};
    }
    return out;
}

Json frame_json(const FrameMeasures& f) {
    return {{"frame", f.frame},
            {"tde", number(f.tde)},
            {"source_tde", number(f.source_tde)},
            {"tde_floor", number(f.tde_floor)},
            {"tde_at_floor", number(f.tde_at_floor)},
            {"sharpness_kept", number(f.sharpness_kept)},
            {"rms_contrast_kept", number(f.rms_contrast_kept)},
            {"matte_chatter_px", number(f.matte_chatter_px)},
            {"mean_v", number(f.mean_v)},
            {"source_mean_v", number(f.source_mean_v)},
            {"steps", steps_json(f.steps)},
            {"region_px", f.region_pixels},
            {"outside_differing_px", f.outside_differing},
            {"outside_max", f.outside_max}};
}

Json per_channel(const std::array<double, 3>& v) {
    return Json::array({v[0], v[1], v[2]});
}

// Grain of the result and of the plate, as amplitudes.
Json grain_json(const GrainSpectrum& grain, const GrainSpectrum& plate) {
    if (grain.blocks == 0 || plate.blocks == 0) return Json();
    Json ratios = Json::array();
    for (std::size_t c = 0; c < 3; ++c) {
        Json bands = Json::array();
        for (std::size_t b = 0; b < GrainSpectrum::kBands; ++b)
            bands.push_back(plate.band[c][b] > 0 ? Json(grain.band[c][b] / plate.band[c][b])
                                                 : Json());
        ratios.push_back(std::move(bands));
    }
    return {{"deviation", per_channel(grain.deviation)},
            {"source_deviation", per_channel(plate.deviation)},
            {"band_ratio", std::move(ratios)},
            {"correlation", number(grain.correlation)},
            {"source_correlation", number(plate.correlation)}};
}

Json edges_json(const ShadowEdges::Summary& e) {
    if (e.edges == 0) return Json();
    return {{"edges", e.edges},
            {"width_ratio", e.width_ratio},
            {"lag_px", e.lag_px},
            {"lag_p90_px", e.lag_p90_px},
            {"missing_share", e.missing_share}};
}

Json two(const std::optional<MedianAnd90>& v) {
    return v ? Json{{"median", v->median}, {"p90", v->p90}} : Json();
}

}  // namespace

Json form_measures_json(const FormMeasures& form) {
    Json frames = Json::array();
    for (const FormMeasures::Frame& f : form.frames) {
        frames.push_back({{"frame", f.frame},
                          {"pixels", f.pixels},
                          {"stretch", two(f.stretch)},
                          {"area_shift_percent", number(f.area_shift_percent)},
                          {"flipped_share", number(f.flipped_share)}});
    }
    return {{"base_frame", form.base_frame ? Json(*form.base_frame) : Json()},
            {"pixels", form.pixels},
            {"stretch", two(form.stretch)},
            {"area_percent", two(form.area_percent)},
            {"rim_stretch", two(form.rim_stretch)},
            {"rim_area_percent", two(form.rim_area_percent)},
            {"flipped_share", number(form.flipped_share)},
            {"torn_share", number(form.torn_share)},
            {"per_frame", std::move(frames)}};
}

Json truth_json(const TruthMeasures& t) {
    return {{"inside", spread(t.inside)},
            {"soft_edge", spread(t.soft_edge)},
            {"shadow", spread(t.shadow)},
            {"brightness_error", t.brightness_error},
            {"shadow_edges", edges_json(t.edges.summary())}};
}

Json light_json(const LightMeasures& light) {
    Json frames = Json::array();
    for (const LightMeasures::Frame& f : light.frames) {
        frames.push_back({{"frame", f.frame},
                          {"correlation", number(f.agreement.correlation)},
                          {"error_levels", f.agreement.error_levels},
                          {"true_deviation_levels", f.agreement.true_deviation_levels}});
    }
    return {{"correlation", spread(light.correlation)},
            {"error_levels", spread(light.error_levels)},
            {"true_deviation_levels", spread(light.true_deviation_levels)},
            {"shadow_edges", edges_json(light.edges)},
            {"per_frame", std::move(frames)}};
}

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
            {"matte_chatter_px", spread(a.matte_chatter_px)},
            {"drift_px", a.drift ? Json(a.drift->mean_px) : Json()},
            {"tiv", a.tiv},
            {"source_tiv", a.source_tiv},
            {"tiv_relative", a.tiv_relative},
            {"grain", grain_json(a.grain, a.source_grain)},
            {"pops", pops_json(a.pops)},
            {"focus_px", spread(o.focus_px)},
            {"source_focus_px", spread(o.source_focus_px)},
            {"outside_differing_px", a.outside_differing},
            {"outside_max", a.outside_max},
            {"per_frame", std::move(frames)}};
}

}  // namespace weft
