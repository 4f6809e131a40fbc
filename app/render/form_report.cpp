#include "app/render/form_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/shot/form_files.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;
using NotSought = FormReport::NotSought;
using Source = FormFinding::Source;

constexpr float kWhole = 0.995f;  // what prints as 100 %
constexpr int kLeastFrames = 2;   // from which motion tells a form, besides the reference frame

NotSought why_not_sought(const Region& region, const RegionPlan& plan) {
    if (plan.form_from != RegionPlan::FormFrom::kNothing || !(plan.form_amount > 0))
        return NotSought::kSought;
    if (region.form.source == FormSource::kFlat) return NotSought::kChosen;
    if (form_files(region).from == RegionPlan::FormFrom::kNothing) return NotSought::kNoPass;
    if (plan.has_uv) return NotSought::kUvPass;
    return region.placement.corners_px ? NotSought::kCorners : NotSought::kUnlocked;
}

std::optional<FormGuideKind> drawn_in(const RegionPlan& plan) {
    if (plan.form_from != RegionPlan::FormFrom::kShape) return std::nullopt;
    const auto shape = std::find_if(plan.form_guides.begin(), plan.form_guides.end(),
                                    [](const FormGuide& guide) { return is_shape(guide.kind); });
    return shape == plan.form_guides.end() ? FormGuideKind::kParallel : shape->kind;
}

std::string drawn_name(FormGuideKind drawn) {
    return std::string(drawn == FormGuideKind::kParallel ? "parallel strokes"
                                                         : info_of(drawn).name);
}

// A reason as the JSON names it, and as a clause after "flat, ".
struct Reason {
    const char* name;
    std::string clause;
};

Reason reason_of(const FormReport& form) {
    if (form.not_sought == NotSought::kSought && !(form.amount > 0))
        return {"amount", "because its amount is 0"};
    switch (form.not_sought) {
        case NotSought::kSought:
            break;
        case NotSought::kChosen:
            return {"chosen", "as chosen"};
        case NotSought::kNoPass:
            return {"no_pass", "because a pass is to show its form, and none is set"};
        case NotSought::kCorners:
            return {"corners", "because its corners give the perspective"};
        case NotSought::kUvPass:
            return {"uv_pass", "because the UV pass gives the exact place already"};
        case NotSought::kUnlocked:
            return {"temporal_mode", "because a form needs the locked temporal mode"};
    }
    const std::string lines = form.lines_asked ? ", and its lines show no plane" : "";
    if (form.finding.frames < kLeastFrames)
        return {"few_frames", "because too few frames show it for motion to tell its form" + lines};
    if (form.finding.no_parallax)
        return {"no_parallax",
                "because the camera only turns or zooms" + lines + "; draw its form by hand"};
    if (!(form.finding.fov_deg > 0))
        return {"not_rigid", "because its motion is not that of a rigid thing" + lines};
    return {"unsure", form.lines_asked
                          ? "because neither motion nor lines tell its form well enough"
                          : "because motion does not tell its form well enough"};
}

std::string frames_of(int frames) {
    return fmt::format("{} frame{}", frames, frames == 1 ? "" : "s");
}

// "± 2°", "± 0.4°"; empty where nothing is known of the error.
std::string error_text(float degrees) {
    if (!(degrees > 0)) return {};
    return degrees < 0.95f ? fmt::format(" ± {:.1f}°", std::max(degrees, 0.1f))
                           : fmt::format(" ± {:.0f}°", degrees);
}

bool has_tilt(const FormFinding& finding) {
    return finding.source == Source::kMotion || finding.source == Source::kLines ||
           (finding.source == Source::kShape && finding.plane);
}

// ", field of view 47° ± 2° by 3 regions"
std::string lens_text(const FormFinding& finding) {
    std::string out =
        fmt::format(", field of view {:.0f}°", finding.fov_deg) + error_text(finding.fov_error_deg);
    if (finding.fov_regions > 1) out += fmt::format(" by {} regions", finding.fov_regions);
    return out;
}

std::string what_was_found(const FormReport& form) {
    const FormFinding& f = form.finding;
    switch (f.source) {
        case Source::kNone:
            break;
        case Source::kPass:
            return "as " + form.pass + " shows it on " + frames_of(f.frames);
        case Source::kMotion:
            return fmt::format("{}, from {} of motion", f.plane ? "plane" : "curved surface",
                               frames_of(f.frames));
        case Source::kShape:
            if (!form.drawn) break;
            return form.drawn == FormGuideKind::kParallel ? "plane, from parallel strokes"
                                                          : drawn_name(*form.drawn) + ", as drawn";
        case Source::kOutline:
            return "round, inflated from its outline";
        case Source::kLines:
            return fmt::format("plane, from straight lines on frame {}", form.frame);
    }
    return {};
}

const char* source_name(Source source) {
    switch (source) {
        case Source::kPass:
            return "pass";
        case Source::kMotion:
            return "motion";
        case Source::kShape:
            return "shape";
        case Source::kOutline:
            return "outline";
        case Source::kLines:
            return "lines";
        case Source::kNone:
            break;
    }
    return "flat";
}

// Single precision in decimal digits that mean something.
double rounded(float value) {
    return std::round(1e3 * static_cast<double>(value)) / 1e3;
}

}  // namespace

Expected<std::vector<FormReport>> form_reports(const Shot& shot, const AnalysisStore& store) {
    std::vector<FormReport> out;
    for (std::size_t k = 0; k < shot.plan.regions.size(); ++k) {
        const RegionPlan& plan = shot.plan.regions[k];
        const Region& region = *shot.project.regions[shot.region_index[k]];
        FormReport form;
        form.region = region.name;
        form.frame = plan.reference_frames.front();
        form.amount = plan.form_amount;
        form.keyed = !plan.form_amount_keys.empty();
        form.not_sought = why_not_sought(region, plan);
        form.lines_asked = may_be_plane(plan.surface);
        if (plan.has_form()) {
            const AnalysisKey key{static_cast<int>(k), form.frame, AnalysisKind::kForm};
            if (!store.has(key)) continue;
            WEFT_TRY(bytes, store.get(key));
            WEFT_TRY(map, decode_form(bytes));
            form.finding = map.finding;
            form.drawn = drawn_in(plan);
            if (form.finding.source == Source::kPass) {
                form.pass = form_files(region).what;
                form.pass.front() = 't';
            }
        }
        out.push_back(std::move(form));
    }
    return out;
}

std::string form_text(const FormReport& form) {
    const FormFinding& f = form.finding;
    if (form.is_flat()) return "flat, " + reason_of(form).clause;
    std::string out = what_was_found(form);
    if (has_tilt(f)) {
        out += fmt::format(", tilted {:.0f}°", f.tilt_deg) + error_text(f.tilt_error_deg) +
               (f.plane ? "" : " in the middle");
    }
    if (f.fov_deg > 0) out += lens_text(f);
    if (f.belief < kWhole) out += fmt::format(", believed to {:.0f} %", 100 * f.belief);
    if (form.keyed)
        out += fmt::format(", amount over time, at most {:.2g}", form.amount);
    else if (form.amount < kWhole)
        out += fmt::format(", amount {:.2g}", form.amount);
    return out;
}

Json form_json(const FormReport& form) {
    const FormFinding& f = form.finding;
    Json out{{"region", form.region},
             {"reference_frame", form.frame},
             {"source", form.is_flat() ? "flat" : source_name(f.source)},
             {"text", form_text(form)},
             {"amount", rounded(form.amount)}};
    if (form.keyed) out["amount_keyed"] = true;
    if (form.is_flat()) {
        out["reason"] = reason_of(form).name;
        return out;
    }
    // A pass is laid as it is; whether it shows a plane is not asked.
    if (f.source != Source::kPass) out["plane"] = f.plane;
    if (form.drawn) out["drawn"] = drawn_name(*form.drawn);
    out["frames"] = f.frames;
    if (has_tilt(f)) {
        out["tilt_deg"] = rounded(f.tilt_deg);
        out["tilt_error_deg"] = rounded(f.tilt_error_deg);
    }
    if (f.fov_deg > 0) out["fov_deg"] = rounded(f.fov_deg);
    if (f.fov_error_deg > 0) out["fov_error_deg"] = rounded(f.fov_error_deg);
    if (f.fov_regions > 0) out["fov_regions"] = f.fov_regions;
    out["belief"] = rounded(f.belief);
    return out;
}

}  // namespace weft
