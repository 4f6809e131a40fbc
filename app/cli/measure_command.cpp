#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/measure/measure_job.h"
#include "app/measure/measure_report.h"
#include "engine/core/frame_range.h"

namespace weft {
namespace {

std::string line(const char* name, const Spread& s) {
    if (s.frames == 0) return std::string(name) + "  not measured\n";
    char text[160];
    std::snprintf(text, sizeof text, "%s  mean %.3f, %.3f to %.3f\n", name, s.mean, s.least,
                  s.largest);
    return text;
}

std::string to_text(const Pops& pops) {
    const std::vector<int> frames = pops.frames();
    std::string text = "pops                 " + std::to_string(frames.size());
    if (!frames.empty()) text += ", on " + format_frame_list(frames);
    text += "\n";
    for (std::size_t k = 0; k < kPopKinds; ++k) {
        const auto kind = static_cast<PopKind>(k);
        const PopsOfKind& p = pops.of(kind);
        if (!(p.deviation > 0)) continue;
        const bool place = kind == PopKind::kPlace;
        char one[160];
        std::snprintf(
            one, sizeof one,
            place ? "  %-10s largest    %.2f px on frame %d (deviation %.2f px), pops %zu\n"
                  : "  %-10s largest    %.1f %% on frame %d (deviation %.1f %%), pops %zu\n",
            name_of(kind), place ? p.largest : 100 * p.largest, p.frame,
            place ? p.deviation : 100 * p.deviation, p.frames.size());
        text += one;
    }
    return text;
}

std::string to_text(const MeasuredResult& o) {
    const SequenceMeasures& a = o.all;
    std::string text =
        std::to_string(a.frames) + " frames, measured with motion: " + a.motion + "\n";
    text += line("TDE of the result  ", a.tde) + line("TDE of the source  ", a.source_tde) +
            line("TDE floor          ", a.tde_floor) + line("TDE at the floor's ", a.tde_at_floor) +
            line("sharpness kept     ", a.sharpness_kept) +
            line("RMS contrast kept  ", a.rms_contrast_kept) +
            line("matte's chatter, px", a.matte_chatter_px);
    char more[400];
    if (a.tde_over_floor) {
        std::snprintf(more, sizeof more, "TDE over floor       %.3f\n", *a.tde_over_floor);
        text += more;
    }
    if (a.drift) {
        std::snprintf(more, sizeof more, "drift                %.3f px\n", a.drift->mean_px);
        text += more;
    }
    std::snprintf(more, sizeof more,
                  "TIV                  %.3f (source %.3f), relative %.6f\noutside the matte    "
                  "%lld pixels differ\n",
                  a.tiv, a.source_tiv, a.tiv_relative, static_cast<long long>(a.outside_differing));
    text += more;
    const GrainSpectrum &g = a.grain, &plate = a.source_grain;
    if (g.blocks > 0 && plate.blocks > 0) {
        std::snprintf(more, sizeof more,
                      "grain R G B          %.2f %.2f %.2f levels (source %.2f %.2f %.2f)\n",
                      g.deviation[0], g.deviation[1], g.deviation[2], plate.deviation[0],
                      plate.deviation[1], plate.deviation[2]);
        text += more;
    }
    text += to_text(a.pops);
    if (o.focus_px.frames > 0 && o.source_focus_px.frames > 0) {
        std::snprintf(more, sizeof more, "edge blur            %.2f px (source %.2f px)\n",
                      o.focus_px.mean, o.source_focus_px.mean);
        text += more;
    }
    return text;
}

std::string edges_text(const ShadowEdges::Summary& e) {
    if (e.edges == 0) return "shadow edges         none\n";
    char text[200];
    std::snprintf(text, sizeof text,
                  "shadow edges         %lld, width %.2f times the true one, off by %.2f px, 90 %% "
                  "below %.2f px\n",
                  static_cast<long long>(e.edges), e.width_ratio, e.lag_px, e.lag_p90_px);
    return text;
}

std::string to_text(const TruthMeasures& t) {
    char text[120];
    std::snprintf(text, sizeof text, "brightness           followed within %.1f %%\n",
                  100 * t.brightness_error);
    return "Against the truth, 8-bit levels:\n" + line("inside             ", t.inside) +
           line("soft edge          ", t.soft_edge) + line("cast shadow        ", t.shadow) + text +
           edges_text(t.edges.summary());
}

std::string to_text(const LightMeasures& light) {
    return "The light estimated from the plate against the true one:\n" +
           line("correlation        ", light.correlation) +
           line("error, levels      ", light.error_levels) +
           line("true deviation     ", light.true_deviation_levels) + edges_text(light.edges);
}

std::string line(const char* name, const std::optional<MedianAnd90>& v, const char* unit) {
    if (!v) return std::string(name) + "  not measured\n";
    char text[160];
    std::snprintf(text, sizeof text, "%s  median %.3f%s, 90 %% below %.3f%s\n", name, v->median,
                  unit, v->p90, unit);
    return text;
}

std::string to_text(const FormMeasures& form) {
    const std::string begin = "The texture on the surface of the position pass:\n";
    if (!form.base_frame) return begin + "too little of the surface to measure\n";
    char shares[160];
    std::snprintf(shares, sizeof shares,
                  "flipped              %.3f %% of the pixels, torn %.3f %%\n",
                  100 * form.flipped_share.value_or(0), 100 * form.torn_share.value_or(0));
    return begin + line("stretch            ", form.stretch, "") +
           line("area distortion    ", form.area_percent, " %") +
           line("stretch at the rim ", form.rim_stretch, "") +
           line("area at the rim    ", form.rim_area_percent, " %") + shares;
}

}  // namespace

CommandResult measure_command(const MeasureCommandOptions& options) {
    use_threads(options.threads);
    MeasureJobOptions job;
    job.project = options.project;
    job.results = {options.result};
    job.estimator = options.estimator;
    job.truth = options.truth;
    job.truth_blur_px = static_cast<float>(options.truth_blur_px);
    job.st = options.st;
    job.pictures = options.pictures;
    job.overwrite = options.write.overwrite;
    job.limits.root = options.write.root;
    job.cache.folder = options.cache;
    WEFT_TRY(outcome, run_measure_job(job, cancel_on_signals()));
    for (const std::string& warning : outcome.warnings)
        print_warning(warning);
    const MeasuredResult& result = outcome.results.front();
    Answer answer{measure_json(result), to_text(result)};
    if (outcome.truth) {
        answer.json["truth"] = truth_json(*outcome.truth);
        answer.text += to_text(*outcome.truth);
    }
    if (outcome.light) {
        answer.json["light"] = light_json(*outcome.light);
        answer.text += to_text(*outcome.light);
    }
    if (outcome.form) {
        answer.json["form"] = form_measures_json(*outcome.form);
        answer.text += to_text(*outcome.form);
    }
    answer.json["warnings"] = outcome.warnings;
    return answer;
}

}  // namespace weft
