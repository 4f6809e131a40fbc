#include "app/jobs/job_progress.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace weft {

bool JobProgress::read(JobView& view, double elapsed_s) {
    const std::vector<std::string> lines = lines_.next();
    for (const std::string& line : lines) {
        const auto event = nlohmann::json::parse(line, nullptr, false);
        if (!event.is_object()) continue;
        try {
            const auto stage = work_stage(event.value("stage", ""));
            if (stage == WorkStage::kRender) {
                view.newest_frame = event.value("frame", 0);
                view.has_frame = true;
            }
            view.done = event.value("done", 0);
            view.total = event.value("total", 0);
            note(view, stage, elapsed_s);
        } catch (const nlohmann::json::exception&) {
            continue;  // not a line of ours
        }
    }
    replays_ = replays_ && lines.empty();
    return !lines.empty();
}

// The rate, the time left and the time elapsed agree: all leave pauses out, and the rate counts
// what was done in this stage, without the frames that were there before.
void JobProgress::note(JobView& view, std::optional<WorkStage> stage, double elapsed_s) {
    if (stage != view.stage || replays_) {
        start_s_ = replays_ ? elapsed_s : view.elapsed_s;
        before_ = replays_ ? view.done : std::max(0, view.done - 1);
    }
    view.stage = stage;
    view.elapsed_s = elapsed_s;
    const double in_stage_s = elapsed_s - start_s_;
    const int done = view.done - before_;
    constexpr double kLeast_s = 0.5;
    if (stage == WorkStage::kRender && in_stage_s > kLeast_s)
        view.frames_per_minute = 60.0 * done / in_stage_s;
    view.left_s = done > 1 ? in_stage_s / done * (view.total - view.done) : 0;
}

}  // namespace weft
