// A study as one HTML file that a person reads.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "app/render/report.h"
#include "bench/study/study_pictures.h"
#include "bench/study/study_report.h"
#include "bench/study/svg_chart.h"
#include "engine/core/frame_range.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

constexpr const char* kStyle = R"(
body{font:15px/1.5 system-ui,"Inter","Segoe UI",sans-serif;color:#1d2126;background:#fff;max-width:1180px;margin:32px auto;padding:0 24px}
h1{font-size:26px;margin:0 0 4px}h2{font-size:19px;margin:40px 0 8px;border-bottom:1px solid #d9dde2;padding-bottom:4px}
p{max-width:78ch}.sub{color:#5b6470}.boxes{display:flex;gap:14px;flex-wrap:wrap;margin:20px 0}
.box{border:1px solid #d9dde2;border-radius:8px;padding:12px 16px;min-width:170px}.box b{display:block;font-size:25px;line-height:1.2}
.box span{color:#5b6470;font-size:13px}
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:14px;margin:10px 0}
th,td{padding:4px 10px;text-align:right;border-bottom:1px solid #e6e9ed}th{font-weight:600;color:#444c56;vertical-align:bottom}
th:first-child,td:first-child{text-align:left}tr.locked td{background:#eaf4ec;font-weight:600}tr.group td{color:#5b6470;font-style:italic;border:0;padding-top:12px}
svg.chart{width:100%;max-width:980px;display:block;margin:14px 0}svg text{font:12px system-ui,sans-serif;fill:#333b44}
svg .title{font-size:14px;font-weight:600}svg .tick{fill:#5b6470;font-size:11px}svg .label{fill:#5b6470}
svg .grid{stroke:#e6e9ed}svg .band{fill:#dff0e3}
.pictures{display:flex;flex-wrap:wrap;gap:8px;margin:4px 0 14px}figure{margin:0}figcaption{font-size:12px;color:#5b6470}
.strip td{vertical-align:top;border:0;padding:4px 6px;text-align:left}.strip img{display:block}
.note{color:#5b6470;font-size:13.5px}code{font-size:13px}.warn{background:#fff6dd;border-left:4px solid #e0b23c;padding:6px 12px;margin:6px 0}
details{margin:10px 0}summary{cursor:pointer}
)";

std::string fixed(const std::optional<double>& v, int digits) {
    return v ? fmt::format("{:.{}f}", *v, digits) : "–";
}

std::optional<double> mean_of(const Spread& s) {
    return s.frames > 0 ? std::optional<double>(s.mean) : std::nullopt;
}

std::string colour_of(const StudyRun& run, int paper_index) {
    static const std::map<std::string, std::string> known{
        {"anew", "#c0392b"},        {"patchmatch", "#d17b0f"}, {"poisson", "#8e6bbf"},
        {"still", "#6b7480"},       {"locked", "#14803c"},     {"full", "#14803c"},
        {"no-graphcut", "#a0522d"}, {"no-time", "#c0392b"}};
    if (const auto at = known.find(run.id); at != known.end()) return at->second;
    constexpr std::array<const char*, 4> kPapers{"#9cc4e8", "#5a9bd4", "#2f6fae", "#123f73"};
    return kPapers[static_cast<std::size_t>(std::min(paper_index, 3))];
}

struct Coloured {
    const StudyRun* run;
    std::string colour;
};

class HtmlReport {
  public:
    explicit HtmlReport(const StudyResult& study) : study_(study) {
        int papers = 0;
        for (const StudyRun& run : study.runs) {
            auto& group = run.role == StudyRole::kAblation ? ablation_
                          : run.role == StudyRole::kLight  ? lights_
                                                           : compared_;
            group.push_back({&run, colour_of(run, papers)});
            papers += run.role == StudyRole::kPaper ? 1 : 0;
        }
    }

    std::string write() {
        out_ = fmt::format(
            "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
            "<meta name=\"viewport\" content=\"width=device-width\"><title>Weft study</title>"
            "<style>{}</style></head><body>\n",
            kStyle);
        head();
        summary();
        transport();
        strip();
        light();
        ablation();
        worst();
        times();
        settings();
        return out_ + "</body></html>\n";
    }

  private:
    void head() {
        const Region& region = *study_.project.regions.front();
        const std::string& texture =
            region.texture.plane.empty() ? region.texture.sample : region.texture.plane;
        out_ += fmt::format(
            "<h1>How still does the texture stay?</h1><p class=\"sub\">Plate <code>{}</code>, "
            "frames {}, {}×{}. Texture <code>{}</code>. Weft {}, backend {}, {} threads.</p>\n",
            html_text(study_.project.plate.path), format_frame_list(study_.frames),
            study_.size.width, study_.size.height, html_text(texture), kVersion, study_.backend,
            thread_count());
        for (const std::string& warning : study_.warnings)
            out_ += "<p class=\"warn\">" + html_text(warning) + "</p>\n";
    }

    [[nodiscard]] std::string title_of(const std::string& id) const {
        const StudyRun* run = study_.find(id);
        return run == nullptr ? id : run->title;
    }

    void box(const std::string& value, const std::string& what) {
        out_ += "<div class=\"box\"><b>" + value + "</b><span>" + what + "</span></div>";
    }

    void summary() {
        const StudyVerdict& v = study_.verdict;
        const StudyRun* locked = study_.find("locked");
        out_ += "<div class=\"boxes\">";
        if (v.reduction_percent) {
            box(fmt::format("{:.1f} %", *v.reduction_percent),
                "less flicker above the floor than<br>the best baseline: " +
                    html_text(title_of(v.baseline_id)));
        }
        if (v.paper_reduction_percent) {
            box(fmt::format("{:.1f} %", *v.paper_reduction_percent),
                "less than the paper's method where it<br>stays sharp: " +
                    html_text(title_of(v.paper_id)));
        }
        const SequenceMeasures& m = locked->measured.all;
        if (m.tde_over_floor)
            box(fmt::format("{:.2f} ×", *m.tde_over_floor), "TDE over the floor, surface-locked");
        if (m.sharpness_kept.frames > 0) {
            box(fmt::format("{:.2f}–{:.2f}", m.sharpness_kept.least, m.sharpness_kept.largest),
                "sharpness kept, surface-locked,<br>least and largest frame");
        }
        if (m.drift) {
            box(fmt::format("{:.2f} px", m.drift->mean_px),
                fmt::format("drift after {} frames,<br>surface-locked", study_.frames.size() - 1));
        }
        out_ += "</div>\n";
        out_ += fmt::format(
            "<p>TDE, the temporal difference error, is how much a result changes along the motion "
            "of its surface, mean over the region, in 8-bit units. The <em>floor</em> is that of "
            "the same texture moved ideally; resampling alone costs that much. Blur lowers the "
            "TDE, so no TDE counts without the sharpness beside it. Motion measured with: <b>{}"
            "</b>{}. Light is off in this comparison, so that the transport alone is judged.</p>\n",
            study_.estimated_ideal ? html_text(m.motion) : "the clip's true motion",
            study_.estimated_ideal
                ? " (no true motion was given: floor and sharpness rest on this estimate, which is "
                  "not the one that rendered)"
                : "");
        if (!v.paper && study_.find("locked") != nullptr && has_papers()) {
            out_ += "<p>The paper's method kept a sharpness of 0.90 at none of these α.</p>\n";
        }
    }

    [[nodiscard]] bool has_papers() const {
        return std::any_of(study_.runs.begin(), study_.runs.end(),
                           [](const StudyRun& r) { return r.role == StudyRole::kPaper; });
    }

    using PerFrame = std::optional<double> FrameMeasures::*;

    void add_line(LineChart& chart, const Coloured& c, PerFrame value) const {
        ChartLine line{c.run->title,
                       c.colour,
                       c.run->role == StudyRole::kPaper,
                       c.run->role == StudyRole::kLocked || c.run->id == "full",
                       {}};
        for (const FrameMeasures& f : c.run->measured.frames)
            line.points.emplace_back(f.frame, f.*value);
        chart.lines.push_back(std::move(line));
    }

    void add_reference(LineChart& chart, const std::string& name, const std::string& colour,
                       PerFrame value) const {
        ChartLine line{name, colour, true, false, {}};
        for (const FrameMeasures& f : study_.find("locked")->measured.frames)
            line.points.emplace_back(f.frame, f.*value);
        chart.lines.push_back(std::move(line));
    }

    void transport() {
        out_ +=
            "<h2>Flicker, sharpness, drift</h2>\n<table><tr><th>method</th><th>TDE</th>"
            "<th>TDE −<br>floor</th><th>times the<br>floor</th><th>sharpness kept<br>mean "
            "(least–largest)</th><th>drift<br>px</th><th>TIV</th><th>TIV<br>relative</th>"
            "<th>CPU s<br>a frame</th></tr>\n";
        const SequenceMeasures& ref = study_.find("locked")->measured.all;
        out_ += fmt::format(
            "<tr class=\"group\"><td>the source clip itself</td><td>{}</td><td></td><td></td><td>"
            "</td><td></td><td>{:.2f}</td><td></td><td></td></tr>"
            "<tr class=\"group\"><td>floor: the texture moved ideally</td><td>{}</td><td></td><td>"
            "</td><td></td><td></td><td></td><td></td><td></td></tr>\n",
            fixed(mean_of(ref.source_tde), 2), ref.source_tiv, fixed(mean_of(ref.tde_floor), 2));
        for (const Coloured& c : compared_)
            transport_row(*c.run);
        out_ += "</table>\n";
        LineChart tde{"TDE per frame (the paper's Fig. 5)",
                      "frame",
                      "TDE, 8-bit units, log scale",
                      true,
                      std::nullopt,
                      {}};
        LineChart sharp{"Sharpness kept per frame (the band is right: 0.95 to 1.08)",
                        "frame",
                        "of the ideal's",
                        false,
                        std::pair(0.95, 1.08),
                        {}};
        for (const Coloured& c : compared_) {
            add_line(tde, c, &FrameMeasures::tde);
            add_line(sharp, c, &FrameMeasures::sharpness_kept);
        }
        add_reference(tde, "Floor", "#111111", &FrameMeasures::tde_floor);
        add_reference(tde, "Source clip", "#b8860b", &FrameMeasures::source_tde);
        out_ += svg_of(tde) + svg_of(sharp);
    }

    void transport_row(const StudyRun& run) {
        const SequenceMeasures& m = run.measured.all;
        const Spread& s = m.sharpness_kept;
        out_ += fmt::format(
            "<tr{}><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.2f}"
            "</td><td>{:.2e}</td><td>{:.2f}</td></tr>\n",
            run.role == StudyRole::kLocked ? " class=\"locked\"" : "", html_text(run.title),
            fixed(mean_of(m.tde), 2), fixed(above_floor(m), 2), fixed(m.tde_over_floor, 2),
            s.frames > 0 ? fmt::format("{:.2f} ({:.2f}–{:.2f})", s.mean, s.least, s.largest)
                         : std::string("–"),
            m.drift ? fmt::format("{:.2f}", m.drift->mean_px) : std::string("–"), m.tiv,
            m.tiv_relative, run.cpu_s / static_cast<double>(study_.frames.size()));
    }

    static std::string image(const StudyPicture& picture) {
        return fmt::format("<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\">",
                           data_uri(picture.jpeg), picture.size.width, picture.size.height,
                           html_text(picture.caption));
    }

    void strip() {
        if (study_.strip.empty()) return;
        out_ += "<h2>Key frames (the paper's Fig. 4)</h2>\n<table class=\"strip\"><tr><th></th>";
        for (const int frame : study_.strip_frames) {
            out_ +=
                fmt::format("<th>frame {} ({}.)</th>", frame, frame - study_.frames.front() + 1);
        }
        out_ += "</tr>\n";
        for (const StripRow& row : study_.strip) {
            out_ += "<tr><td>" + html_text(row.title) + "</td>";
            for (const StudyPicture& picture : row.pictures)
                out_ += "<td>" + image(picture) + "</td>";
            out_ += "</tr>\n";
        }
        out_ += "</table>\n";
    }

    void light() {
        if (ablation_.empty() && lights_.empty()) return;
        out_ +=
            "<h2>Light through time (the paper's Fig. 6)</h2>\n<p>TIV is the variance over "
            "time of the region's mean V. Where the light of the scene changes, the smallest "
            "TIV is not the right one: the result should brighten as the source does, and TIV "
            "relative, the variance of their normalised difference, should be small.</p>\n";
        LineChart mean{"Mean V of the region", "frame", "V, 8-bit units", false, std::nullopt, {}};
        std::vector<Bar> tiv, relative;
        const auto add = [&](const Coloured& c, const std::string& name) {
            const SequenceMeasures& m = c.run->measured.all;
            tiv.push_back({name, {{"", c.colour, m.tiv}}, fmt::format("{:.2f}", m.tiv)});
            relative.push_back(
                {name, {{"", c.colour, m.tiv_relative}}, fmt::format("{:.2e}", m.tiv_relative)});
        };
        for (const Coloured& c : compared_) {
            add(c, c.run->title + (c.run->role == StudyRole::kLocked ? ", without light" : ""));
            if (c.run->role == StudyRole::kLocked) {
                add_line(mean, {c.run, "#6b7480"}, &FrameMeasures::mean_v);
                mean.lines.back().name = "Without light";
            }
        }
        for (const Coloured& c : ablation_) {
            add(c, c.run->title + (c.run->id == "full" ? "" : ", with light"));
            if (c.run->id == "full") add_line(mean, c, &FrameMeasures::mean_v);
        }
        for (const Coloured& c : lights_)
            add(c, c.run->title);
        add_reference(mean, "Source clip", "#b8860b", &FrameMeasures::source_mean_v);
        const double source = study_.find("locked")->measured.all.source_tiv;
        tiv.push_back({"Source clip", {{"", "#b8860b", source}}, fmt::format("{:.2f}", source)});
        out_ += svg_of(mean) + svg_of_bars("TIV", "squared 8-bit units", tiv) +
                svg_of_bars("TIV relative", "", relative);
        out_ += study_light_html(study_);
    }

    void ablation() {
        const StudyRun* full = study_.find("full");
        if (full == nullptr) return;
        out_ +=
            "<h2>What each part is worth (the paper's Fig. 7)</h2>\n<p>The full method with "
            "light, and without one of its parts. The TDE includes the change of the light, "
            "which the source clip has too.</p>\n<table><tr><th></th><th>TDE</th>"
            "<th>sharpness<br>kept</th><th>seam energy<br>per area</th><th>TIV<br>relative"
            "</th></tr>\n";
        for (const Coloured& c : ablation_)
            ablation_row(*c.run, c.run->title, c.run->id == "full");
        ablation_row(*study_.find("locked"), "Without light", false);
        out_ += "</table>\n";
    }

    void ablation_row(const StudyRun& run, const std::string& title, bool strong) {
        const SequenceMeasures& m = run.measured.all;
        out_ +=
            fmt::format("<tr{}><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.2e}</td></tr>\n",
                        strong ? " class=\"locked\"" : "", html_text(title),
                        fixed(mean_of(m.tde), 2), fixed(mean_of(m.sharpness_kept), 2),
                        run.plane ? fmt::format("{:.3f}", run.plane->seam_energy_per_area) : "–",
                        m.tiv_relative);
    }

    void worst() {
        if (study_.worst.empty()) return;
        out_ +=
            "<h2>The worst step of each method</h2>\n<p>Where a method changes most from one "
            "frame to the next, at 100 %: a frame, the luma of its neighbour moved onto it "
            "along the motion, and the difference of the lumas four times over. A still "
            "surface is black there.</p>\n";
        for (const WorstStep& step : study_.worst) {
            out_ +=
                fmt::format("<div><b>{}</b>, frame {}: TDE {:.2f}</div><div class=\"pictures\">",
                            html_text(step.title), step.frame, step.tde);
            for (const StudyPicture& picture : step.pictures) {
                out_ += "<figure>" + image(picture) + "<figcaption>" + html_text(picture.caption) +
                        "</figcaption></figure>";
            }
            out_ += "</div>\n";
        }
    }

    void times() {
        out_ += "<h2>Time</h2>\n";
        std::vector<Bar> bars;
        for (const StudyRun& run : study_.runs) {
            const StageSeconds& s = run.seconds;
            bars.push_back({run.title,
                            {{"analyse", "#5a9bd4", s.analyse},
                             {"synthesise", "#d17b0f", s.synthesise},
                             {"render", "#14803c", s.render}},
                            fmt::format("{:.1f} s", s.total)});
        }
        out_ += svg_of_bars("Time per stage (the paper's Fig. 1)",
                            fmt::format("seconds of wall clock for {} frames; every method starts "
                                        "without an analysis",
                                        study_.frames.size()),
                            bars);
        lighting_share();
    }

    // The paper's Table 1: its frames are synthesised one by one.
    void lighting_share() {
        const StudyRun *full = study_.find("full"), *locked = study_.find("locked"),
                       *anew = study_.find("anew");
        if (full == nullptr) return;
        const auto frames = static_cast<double>(study_.frames.size());
        const double lighting = std::max(0.0, full->cpu_s - locked->cpu_s) / frames;
        out_ +=
            "<p>Lighting share (the paper's Table 1), CPU seconds of all threads. Lighting is "
            "what the full method takes more than the same without light.</p>\n"
            "<table><tr><th>output</th><th>graph cut (s)</th><th>lighting (s)</th>"
            "<th>total (s)</th><th>lighting /<br>graph cut</th></tr>\n";
        const auto row = [&](const std::string& name, double cut, double light_s) {
            out_ += fmt::format(
                "<tr><td>{}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.1f} %</td>"
                "</tr>\n",
                name, cut, light_s, cut + light_s, 100 * light_s / std::max(1e-9, cut));
        };
        if (anew != nullptr) {
            row(fmt::format("one frame, {}×{}, synthesised anew", study_.size.width,
                            study_.size.height),
                anew->cpu_s / frames, lighting);
        }
        if (locked->plane) {
            row(fmt::format("all {} frames, surface-locked: one plane", study_.frames.size()),
                locked->plane->total_s, lighting * frames);
        }
        row("all of a frame by the full method", full->cpu_s / frames - lighting, lighting);
        row("the paper, 512×512", 8.42, 0.91);
        row("the paper, 1024×1024", 28.35, 3.47);
        out_ += "</table>\n";
    }

    void settings() {
        out_ +=
            "<h2>Settings</h2>\n<details><summary>Every parameter of the clip</summary>"
            "<table><tr><th>parameter</th><th>value</th></tr>\n";
        const auto json = settings_json(study_.project);
        rows(json.at("project"));
        for (const auto& region : json.at("regions"))
            rows(region);
        out_ +=
            "</table></details>\n<p class=\"note\">The same figures stand in report.json, and "
            "for every frame in report.csv. The frames of each method lie in frames/.</p>\n";
    }

    void rows(const nlohmann::ordered_json& settings) {
        for (const auto& [key, value] : settings.items()) {
            const std::string text =
                value.is_string()
                    ? value.get<std::string>()
                    : value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
            if (text.empty() || text == "null") continue;
            out_ += "<tr><td>" + html_text(key) + "</td><td>" + html_text(text) + "</td></tr>\n";
        }
    }

    const StudyResult& study_;
    std::vector<Coloured> compared_, lights_, ablation_;
    std::string out_;
};

}  // namespace

std::string study_html(const StudyResult& study) {
    return HtmlReport(study).write();
}

}  // namespace weft
