#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/session/measure_job.h"
#include "app/session/measure_report.h"

namespace weft {
namespace {

std::string line(const char* name, const Spread& s) {
    if (s.frames == 0) return std::string(name) + "  not measured\n";
    char text[160];
    std::snprintf(text, sizeof text, "%s  mean %.3f, %.3f to %.3f\n", name, s.mean, s.least,
                  s.largest);
    return text;
}

std::string to_text(const MeasuredResult& o) {
    const SequenceMeasures& a = o.all;
    std::string text =
        std::to_string(a.frames) + " frames, measured with motion: " + a.motion + "\n";
    text += line("TDE of the result  ", a.tde) + line("TDE of the source  ", a.source_tde) +
            line("TDE floor          ", a.tde_floor) + line("TDE at the floor's ", a.tde_at_floor) +
            line("sharpness kept     ", a.sharpness_kept) +
            line("RMS contrast kept  ", a.rms_contrast_kept);
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
    return text + more;
}

}  // namespace

int measure_command(const MeasureCommandOptions& options) {
    use_threads(options.threads);
    MeasureJobOptions job;
    job.project = options.project;
    job.results = {options.result};
    job.estimator = options.motion_estimator == "farneback" ? MeasuringEstimator::kFarneback
                                                            : MeasuringEstimator::kDeepFlow;
    const auto outcome = run_measure_job(job, cancel_on_signals());
    if (!outcome) return report_error(outcome.error());
    for (const std::string& warning : outcome->warnings)
        print_warning(warning);
    const MeasuredResult& result = outcome->results.front();
    if (!options.json) {
        print(stdout, to_text(result));
        return 0;
    }
    nlohmann::ordered_json json = measure_json(result);
    json["warnings"] = outcome->warnings;
    print(stdout, json.dump(2) + "\n");
    return 0;
}

}  // namespace weft
