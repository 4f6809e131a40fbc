#pragma once
// From a failed job to what its error is about.

#include "ui/base/ctx.h"

namespace weft::ui {

inline constexpr const char* kShowProblem = "Show what it is about";

/// Whether the job is one of the shot that is open.
[[nodiscard]] bool shows(const Ctx& c, const JobView& job);
/// Goes to the frame, selects the region, opens the workspace of the setting and marks its control.
void show_problem(Ctx& c, const JobProblem& problem);

}  // namespace weft::ui
