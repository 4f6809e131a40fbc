#pragma once
#include "app/session/study.h"

namespace weft {

/// A run that is still to be rendered, with the project that makes it.
struct StudyMethod {
    enum class Kind { kJob, kPatchMatch, kPoisson };
    Kind kind = Kind::kJob;
    StudyRun run;
    Project project;
};

/// The runs of a study, in the report's order. `project`: as prepared (mattes for every frame, one
/// reference frame, no motion unless it is to be rendered with). `plane`: the grown plane's file,
/// shown as it is by the methods that do not grow one. Errors: Usage.
[[nodiscard]] Expected<std::vector<StudyMethod>> plan_study(const StudyOptions& options,
                                                            const Project& project,
                                                            const std::string& plane);

/// Renders a kPatchMatch or kPoisson method. Errors: of reading and writing; cancellation.
[[nodiscard]] Expected<StageSeconds> render_baseline(const StudyMethod& method,
                                                     const std::string& plane,
                                                     const CancelToken& cancel,
                                                     const ProgressFn& progress);

}  // namespace weft
