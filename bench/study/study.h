#pragma once
// Renders one clip by every method and measures all alike, as evidence that the texture stays in
// place (`weft study`).

#include <optional>
#include <string>
#include <vector>

#include "app/measure/measure_job.h"
#include "app/render/render_job.h"

namespace weft {

struct StudyOptions {
    /// Plate, one region with matte, texture, placement and (to measure with) true motion; paths
    /// resolved. What the methods differ in, its temporal mode, seam and light, is set by the
    /// study.
    Project project;
    std::string folder;                         ///< Where report, pictures and frames go.
    std::vector<std::string> methods;           ///< Of study_method_names(); empty: all.
    std::vector<double> alphas{0.2, 0.5, 1.0};  ///< The paper mode's blends.
    /// Renders with the true motion too, instead of the estimate.
    bool render_with_motion = false;
    int threads = 0;
    std::string texture_library;  ///< For a texture "db:ID"; empty: the user's own.
    bool overwrite = false;       ///< Replace an earlier report and its frames.
    WriteLimits limits;
};

/// The role of a method in the comparison.
enum class StudyRole {
    kBaseline,  ///< Baselines: anew, PatchMatch, Poisson, still.
    kPaper,     ///< The paper's eq. 4–6 at one α.
    kLocked,
    kLight,    ///< With light in another form, or with all effects of the plate's camera.
    kAblation  ///< With light: the full method, and the method without one of its parts.
};

/// One method's frames, times and figures.
struct StudyRun {
    std::string id, title;
    StudyRole role = StudyRole::kBaseline;
    double alpha = 0;     ///< kPaper
    bool lit = false;     ///< With the project's light and lines; else both are off.
    std::string pattern;  ///< Of its frames.
    StageSeconds seconds;
    double cpu_s = 0;  ///< Of all threads, over all stages.
    std::optional<PlaneStats> plane;
    MeasuredResult measured;
};

/// A picture in the report.
struct StudyPicture {
    std::string caption;
    std::vector<std::uint8_t> jpeg;
    Size size;
};

/// A method's worst step: the frame before, warped; the frame; and four times their difference.
struct WorstStep {
    std::string title;
    int frame = 0;
    double tde = 0;
    std::vector<StudyPicture> pictures;
};

/// A row of the strip of key frames.
struct StripRow {
    std::string title;
    std::vector<StudyPicture> pictures;
};

/// How much closer to the floor the surface-locked mode is. Each is mean TDE − mean floor over the
/// floor's pixels, 8-bit units; empty without a floor or if the method was not run.
struct StudyVerdict {
    std::optional<double> floor, locked, baseline, paper;
    std::string baseline_id, paper_id;
    /// 100 (1 − locked / baseline): against the best of the baselines.
    std::optional<double> reduction_percent;
    /// The same against the paper mode at the smallest α whose mean sharpness is at least 0.90.
    std::optional<double> paper_reduction_percent;
};

struct StudyResult {
    Project project;  ///< As studied.
    std::vector<int> frames;
    Size size;
    std::string backend;
    bool estimated_ideal = false;  ///< Floor and sharpness use the measuring estimate of motion.
    std::vector<StudyRun> runs;
    std::vector<StripRow> strip;
    std::vector<int> strip_frames;
    std::vector<StripRow> light_strip;   ///< Light and reflectance, before and after.
    std::optional<LightMeasures> light;  ///< Against the artist's pass, where there is one.
    std::vector<WorstStep> worst;
    std::vector<std::string> warnings;
    StudyVerdict verdict;

    /// The run with this id, or null.
    [[nodiscard]] const StudyRun* find(const std::string& id) const;
};

/// anew, patchmatch, poisson, still, paper, locked, light, ablation.
[[nodiscard]] const std::vector<std::string>& study_method_names();

/// Renders every method into `folder`/frames/ID, measures all, and writes report.html (one
/// self-contained file), report.json and report.csv. Errors: Usage for a project without exactly
/// one region, frames that are not consecutive, an unknown method or an existing report; those of
/// rendering and measuring; cancellation.
[[nodiscard]] Expected<StudyResult> run_study(const StudyOptions& options,
                                              const CancelToken& cancel,
                                              const ProgressFn& progress);

/// Mean TDE − mean floor over the floor's pixels; empty without a floor.
[[nodiscard]] std::optional<double> above_floor(const SequenceMeasures& measures);
[[nodiscard]] StudyVerdict study_verdict(const std::vector<StudyRun>& runs);

}  // namespace weft
