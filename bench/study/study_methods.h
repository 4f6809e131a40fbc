#pragma once
#include "bench/study/study.h"

namespace weft {

/// A run before rendering, with its project.
struct StudyMethod {
    enum class Kind { kJob, kPatchMatch, kPoisson };
    Kind kind = Kind::kJob;
    StudyRun run;
    Project project;
};

/// Checks the methods and blends of a study before anything is written. Errors: Usage.
[[nodiscard]] Status check_study(const StudyOptions& options);

/// The runs of a study, in the report's order. `project`: as prepared (mattes for every frame, one
/// reference frame, no motion unless it is to be rendered with). `plane`: the grown plane's file,
/// shown as it is by the methods that do not grow one. The options have passed check_study().
[[nodiscard]] Expected<std::vector<StudyMethod>> plan_study(const StudyOptions& options,
                                                            const Project& project,
                                                            const std::string& plane);

/// Renders a kPatchMatch or kPoisson method. Errors: of reading and writing; cancellation.
[[nodiscard]] Expected<StageSeconds> render_baseline(const StudyMethod& method,
                                                     const std::string& plane,
                                                     const WriteRule& rule,
                                                     const CancelToken& cancel,
                                                     const ProgressFn& progress);

}  // namespace weft
