// A study as JSON and CSV.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/measure/measure_report.h"
#include "app/render/report.h"
#include "bench/study/study_report.h"
#include "engine/core/frame_range.h"
#include "engine/core/parallel.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(StudyRole role) {
    switch (role) {
        case StudyRole::kBaseline:
            return "baseline";
        case StudyRole::kPaper:
            return "paper";
        case StudyRole::kLocked:
            return "locked";
        case StudyRole::kLight:
            return "light";
        case StudyRole::kAblation:
            break;
    }
    return "ablation";
}

Json number(const std::optional<double>& v) {
    return v ? Json(*v) : Json();
}

Json run_json(const StudyRun& run) {
    Json out{{"id", run.id},
             {"title", run.title},
             {"role", name_of(run.role)},
             {"light", run.lit},
             {"seconds_per_stage",
              {{"open", run.seconds.open},
               {"analyse", run.seconds.analyse},
               {"synthesise", run.seconds.synthesise},
               {"render", run.seconds.render},
               {"total", run.seconds.total}}},
             {"cpu_seconds", run.cpu_s},
             {"tde_above_floor", number(above_floor(run.measured.all))}};
    if (run.role == StudyRole::kPaper) out["alpha"] = run.alpha;
    if (run.plane) {
        out["plane"] = {{"seconds", run.plane->total_s},
                        {"seam_energy_per_area", run.plane->seam_energy_per_area},
                        {"seam_length_px", run.plane->seam_length_px}};
    }
    out["measures"] = measure_json(run.measured);
    return out;
}

}  // namespace

std::string study_json(const StudyResult& study) {
    const StudyVerdict& v = study.verdict;
    Json runs = Json::array();
    for (const StudyRun& run : study.runs)
        runs.push_back(run_json(run));
    Json out{{"version", kVersion},
             {"plate", study.project.plate.path},
             {"frames", format_frame_list(study.frames)},
             {"size", {study.size.width, study.size.height}},
             {"backend", study.backend},
             {"threads", thread_count()},
             {"ideal_by_estimate", study.estimated_ideal},
             {"verdict",
              {{"tde_floor", number(v.floor)},
               {"locked_above_floor", number(v.locked)},
               {"best_baseline", v.baseline_id},
               {"best_baseline_above_floor", number(v.baseline)},
               {"reduction_percent", number(v.reduction_percent)},
               {"sharp_paper", v.paper_id},
               {"sharp_paper_above_floor", number(v.paper)},
               {"paper_reduction_percent", number(v.paper_reduction_percent)}}},
             {"runs", std::move(runs)},
             {"settings", settings_json(study.project)},
             {"warnings", study.warnings}};
    if (study.light) out["light"] = light_json(*study.light);
    return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string study_csv(const StudyResult& study) {
    std::string out =
        "method,frame,tde,source_tde,tde_floor,tde_at_floor,sharpness_kept,rms_contrast_kept,"
        "mean_v,source_mean_v\n";
    const auto cell = [](const std::optional<double>& v) {
        return v ? fmt::format(",{:.6g}", *v) : std::string(",");
    };
    for (const StudyRun& run : study.runs) {
        for (const FrameMeasures& f : run.measured.frames) {
            out += run.id + "," + std::to_string(f.frame) + cell(f.tde) + cell(f.source_tde) +
                   cell(f.tde_floor) + cell(f.tde_at_floor) + cell(f.sharpness_kept) +
                   cell(f.rms_contrast_kept) + cell(f.mean_v) + cell(f.source_mean_v) + "\n";
        }
    }
    return out;
}

}  // namespace weft
