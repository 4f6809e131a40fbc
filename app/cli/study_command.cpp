#include "app/cli/commands.h"
#include "app/session/study_report.h"

namespace weft {
namespace {

std::string line(const StudyRun& run) {
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

std::string to_text(const StudyResult& study, const std::string& folder) {
    std::string out;
    for (const StudyRun& run : study.runs)
        out += line(run);
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

int study_command(const StudyOptions& options, const RunOptions& run) {
    const auto study =
        run_study(options, cancel_on_signals(), progress_printer(run.progress, run.json));
    if (!study) return report_error(study.error());
    for (const std::string& warning : study->warnings)
        print_warning(warning);
    print(stdout, run.json ? study_json(*study) : to_text(*study, options.folder));
    return 0;
}

}  // namespace weft
