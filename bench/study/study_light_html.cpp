// What a study says of light, grain and focus.

#include <fmt/format.h>

#include <algorithm>

#include "bench/study/study_pictures.h"
#include "bench/study/study_report.h"

namespace weft {
namespace {

std::string light_strip(const StudyResult& study) {
    if (study.light_strip.empty()) return {};
    std::string out =
        "<h3>Shading and reflectance, before and after</h3><p>Light is shown as a grey of 0.35 "
        "under it. What is seen in the result is estimated from the result alone.</p>\n"
        "<table class=\"strip\">\n";
    for (const StripRow& row : study.light_strip) {
        out += "<tr><td>" + row.title + "</td>";
        for (const StudyPicture& picture : row.pictures) {
            out += fmt::format("<td><img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\"></td>",
                               data_uri(picture.jpeg), picture.size.width, picture.size.height,
                               picture.caption);
        }
        out += "</tr>\n";
    }
    return out + "</table>\n";
}

std::string true_light(const StudyResult& study) {
    if (!study.light) return {};
    const LightMeasures& l = *study.light;
    std::string out = fmt::format(
        "<h3>Φ against the true light</h3><p>Over {} frames: correlation {:.3f} ({:.3f}–{:.3f}), "
        "mean error {:.1f} levels, where the true light deviates by {:.1f} levels itself.",
        l.frames.size(), l.correlation.mean, l.correlation.least, l.correlation.largest,
        l.error_levels.mean, l.true_deviation_levels.mean);
    if (l.edges.edges > 0) {
        out += fmt::format(
            " {} shadow edges: {:.2f} times as wide as the true ones, {:.2f} px off (90 % below "
            "{:.2f} px), {:.0f} % of them missing.",
            l.edges.edges, l.edges.width_ratio, l.edges.lag_px, l.edges.lag_p90_px,
            100 * l.edges.missing_share);
    }
    return out + "</p>\n";
}

// The delivered picture beside the plate: by channel and band of frequency.
std::string grain_and_focus(const StudyResult& study) {
    const StudyRun* run = study.find("finished");
    if (run == nullptr) return {};
    std::string out;
    const GrainSpectrum &g = run->measured.all.grain, &plate = run->measured.all.source_grain;
    if (g.blocks > 0 && plate.blocks > 0) {
        out +=
            "<h3>Grain and focus of the finished result</h3><p>What differs along the motion, "
            "levels. Bands are of spatial frequency, the lowest first: the result's over the "
            "plate's.</p><table><tr><th></th><th>plate</th><th>result</th><th>1</th><th>2</th>"
            "<th>3</th><th>4</th></tr>\n";
        for (std::size_t c = 0; c < 3; ++c) {
            out += fmt::format("<tr><td>{}</td><td>{:.2f}</td><td>{:.2f}</td>", "RGB"[c],
                               plate.deviation[c], g.deviation[c]);
            for (std::size_t b = 0; b < GrainSpectrum::kBands; ++b)
                out +=
                    fmt::format("<td>{:.2f}</td>", g.band[c][b] / std::max(1e-9, plate.band[c][b]));
            out += "</tr>\n";
        }
        out += fmt::format(
            "</table><p>Correlation from one difference to the next: plate {:.2f}, result "
            "{:.2f}.</p>\n",
            plate.correlation.value_or(0), g.correlation.value_or(0));
    }
    const MeasuredResult& m = run->measured;
    if (m.focus_px.frames > 0 && m.source_focus_px.frames > 0) {
        out += fmt::format("<p>Blur of the sharper edges: plate {:.2f} px, result {:.2f} px.</p>\n",
                           m.source_focus_px.mean, m.focus_px.mean);
    }
    return out;
}

}  // namespace

std::string study_light_html(const StudyResult& study) {
    return light_strip(study) + true_light(study) + grain_and_focus(study);
}

}  // namespace weft
