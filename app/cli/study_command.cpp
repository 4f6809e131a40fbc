#include "app/cli/commands.h"
#include "bench/study/study_report.h"

namespace weft {
namespace {

std::string run_line(const StudyRun& run) {
    const SequenceMeasures& m = run.measured.all;
    const auto above = above_floor(m);
    char text[200];
    std::snprintf(text, sizeof text, "%-14s TDE %7.3f", run.id.c_str(), m.tde.mean);
    std::string out = text;
    if (above) {
        std::snprintf(text, sizeof text, "  above the floor %7.3f", *above);
        out += text;
    }
    if (m.sharpness_kept.frames > 0) {
        std::snprintf(text, sizeof text, "  sharpness %.2f", m.sharpness_kept.mean);
        out += text;
    }
    if (m.drift) {
        std::snprintf(text, sizeof text, "  drift %.2f px", m.drift->mean_px);
        out += text;
    }
    return out + "\n";
}

std::string study_text(const StudyResult& study, const std::string& folder) {
    std::string out;
    for (const StudyRun& run : study.runs)
        out += run_line(run);
    const StudyVerdict& v = study.verdict;
    char text[200];
    if (v.reduction_percent) {
        std::snprintf(
            text, sizeof text,
            "surface-locked is %.1f %% closer to the floor (%.3f) than the best baseline, "
            "%s\n",
            *v.reduction_percent, *v.floor, v.baseline_id.c_str());
        out += text;
    }
    return out + folder + "/report.html\n";
}

}  // namespace

CommandResult study_command(const StudyOptions& options, const RunOptions& run) {
    WEFT_TRY(study, run_study(options, cancel_on_signals(), progress_printer(run.progress)));
    for (const std::string& warning : study.warnings)
        print_warning(warning);
    Answer answer{nlohmann::ordered_json::parse(study_json(study)),
                  study_text(study, options.folder)};
    answer.json["report"] = absolute_path(options.folder + "/report.html");
    return answer;
}

}  // namespace weft
