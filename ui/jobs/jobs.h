#pragma once
// The Jobs page.

#include "ui/base/ctx.h"

namespace weft::ui {

void jobs_page(Ctx& c, ImVec2 size);
/// Calibrates the estimate with the times of finished jobs.
void learn_from_jobs(Ctx& c);

}  // namespace weft::ui
