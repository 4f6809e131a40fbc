#include "ui/jobs/job_words.h"

#include "engine/core/text.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {

const char* job_state_name(const JobView& job) {
    switch (job.state) {
        case JobState::kWaiting:
            return "Waiting";
        case JobState::kRunning:
            if (!job.stage) return "Starting";
            if (job.stage == WorkStage::kAnalyse) return "Analysing";
            if (job.stage == WorkStage::kWait) return "Taking the editor's analysis";
            return "Rendering";
        case JobState::kPaused:
            return "Paused";
        case JobState::kDone:
            return "Done";
        case JobState::kCancelled:
            return "Cancelled";
        case JobState::kFailed:
            return "Failed";
    }
    return "";
}

std::string job_line(const JobView& job) {
    std::string out = job_state_name(job);
    if (!job.error.empty()) return out + ". " + job.error;
    if (job.total > 0) out += "  " + std::to_string(job.done) + " of " + std::to_string(job.total);
    if (job.left_s > 0) out += "   " + time_text(job.left_s) + " left";
    if (job.frames_per_minute > 0)
        out += "   " + number_text(job.frames_per_minute, 1) + " frames a minute";
    const bool done = job.state == JobState::kDone;
    if (job.elapsed_s > 0)
        out += std::string(done ? "   in " : "   ") + time_text(job.elapsed_s) +
               (done ? "" : " elapsed");
    return out;
}

std::string job_summary(const JobView& job) {
    std::string out =
        "Job " + std::to_string(job.id) + ": " + lower_case(std::string(job_state_name(job)));
    if (job.total > 0) out += " " + percent_text(job.done, job.total);
    const bool runs = job.state == JobState::kRunning;
    if (runs && job.left_s > 0) out += ", " + time_text(job.left_s) + " left";
    return out;
}

}  // namespace weft::ui
