#pragma once
// What a render job says while it works.

#include <optional>
#include <string>
#include <vector>

#include "app/base/detached_process.h"
#include "app/jobs/job_view.h"

namespace weft {

/// Follows a job's progress file. Belongs to one thread.
class JobProgress {
  public:
    /// `from_start`: nothing was written before, as of a job that has just been begun; else the
    /// rate counts from the first read() on.
    JobProgress(const std::string& file, bool from_start) : lines_(file), replays_(!from_start) {}
    /// Brings the stage, frames and rates of `view` up to date; `elapsed_s`: of the job, without
    /// pauses. Returns whether anything was written since the last call.
    [[nodiscard]] bool read(JobView& view, double elapsed_s);

  private:
    void note(JobView& view, std::optional<WorkStage> stage, double elapsed_s);

    WrittenLines lines_;
    bool replays_;
    double start_s_ = 0;
    int before_ = 0;
};

}  // namespace weft
