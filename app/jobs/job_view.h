#pragma once
// What is shown of a render job.

#include <cstdint>
#include <optional>
#include <string>

#include "app/base/picture.h"
#include "engine/core/progress.h"

namespace weft {

enum class JobState : std::uint8_t { kWaiting, kRunning, kPaused, kDone, kCancelled, kFailed };

[[nodiscard]] constexpr bool is_over(JobState state) {
    return state == JobState::kDone || state == JobState::kCancelled || state == JobState::kFailed;
}

/// What the error of a job is about, as far as it says so.
struct JobProblem {
    std::optional<int> frame;  ///< Of the plate.
    std::string region;        ///< Its name.
    std::string setting;       ///< A key, as in engine/core/setting.h.

    [[nodiscard]] bool known() const { return frame || !region.empty() || !setting.empty(); }
    bool operator==(const JobProblem&) const = default;
};

struct JobView {
    int id = 0;  ///< In this process.
    JobState state = JobState::kWaiting;
    std::string label, output, error;
    std::optional<WorkStage> stage;  ///< Empty: it is starting.
    JobProblem problem;              ///< Of a failed job.
    int done = 0, total = 0;  ///< Finished frames; frames of the analysis while `stage` says so.
    int newest_frame = 0;     ///< 0: none yet.
    bool has_frame = false;
    double elapsed_s = 0, left_s = 0, frames_per_minute = 0;
    /// As submitted; 0 after a pause or retry, when it no longer holds, and once it was compared.
    double estimated_s = 0;
    PicturePtr thumbnail;  ///< Thumbnail of the newest frame.
    std::string log_path, movie;
    std::string plate;     ///< Of its shot, absolute.
    std::string project;   ///< The project's file, absolute; empty if it was never saved.
    bool mine = false;     ///< This process has submitted it.
    bool earlier = false;  ///< It was over when this process first saw it.
};

}  // namespace weft
