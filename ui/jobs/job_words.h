#pragma once
// What is said of a render in the queue.

#include <string>

#include "ui/base/ctx.h"

namespace weft::ui {

/// What it is doing: "Waiting", "Analysing", "Failed".
[[nodiscard]] const char* job_state_name(const JobView& job);
/// A line of what it is doing, how far it has come and how long it takes, or why it failed.
[[nodiscard]] std::string job_line(const JobView& job);
/// The same in brief, for the status bar: "Job 2: analysing 37 %, 1:12 left".
[[nodiscard]] std::string job_summary(const JobView& job);

}  // namespace weft::ui
