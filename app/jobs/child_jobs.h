#pragma once
// Render jobs as child processes: `weft render` on a snapshot of the project. A crash of either
// side does not affect the other, and a render continues when the editor is closed.

#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "app/jobs/job_view.h"
#include "app/jobs/job_worker.h"
#include "app/project/project.h"
#include "engine/core/error.h"

namespace weft {

struct RenderRequest {
    Project project;           ///< With absolute paths.
    std::string project_file;  ///< Where it is saved, absolute; empty: nowhere.
    std::string label;         ///< "Frames 1001-1048 to out/####.png"
    std::vector<int> frames;
    bool overwrite = false, skip_existing = false;
    double estimated_s = 0;  ///< Estimated time, s; 0: not known.
    std::string backend = "auto";
};

/// Runs one job at a time of all processes that use the same folder; the others wait in order. The
/// queue is in that folder: it has the jobs of earlier and of other processes, too. Thread-safe;
/// does not block, except for submit() and the destructor, which finishes what was commanded.
class ChildJobs {
  public:
    /// `program`: the weft program. `folder`: for records, snapshots and logs; created if missing.
    ChildJobs(std::string program, std::string folder);
    /// Does not stop running jobs; see cancel_all().
    ~ChildJobs();
    ChildJobs(const ChildJobs&) = delete;
    ChildJobs& operator=(const ChildJobs&) = delete;

    /// Adds a job and returns its id. Errors: the snapshot or the record cannot be written.
    [[nodiscard]] Expected<int> submit(const RenderRequest& request);
    void cancel(int id);
    void pause(int id);
    void resume(int id);
    /// Runs a job again and keeps existing frames.
    void retry(int id);
    /// Removes a finished job from the list.
    void remove(int id);
    /// The estimate was compared with the time that the job took.
    void forget_estimate(int id);
    /// Moves a job that waits before the one that waits before it (−1), or after the next (1).
    void move(int id, int direction);
    void cancel_all();

    /// By place: the jobs that wait are begun in this order.
    [[nodiscard]] std::vector<JobView> views() const;
    [[nodiscard]] bool busy() const;
    /// Increases with every change.
    [[nodiscard]] std::uint64_t changes() const;
    /// The last lines of a job's log.
    [[nodiscard]] std::string log_tail(int id, std::size_t most_bytes = 8192) const;

  private:
    /// Carries out `change` on the record of the job.
    void command(int id, std::function<void(JobRecord&)> change);
    void command_all(JobCommandFn command);
    [[nodiscard]] std::string name_of(int id) const;

    JobsShared shared_;
    std::thread thread_;
};

}  // namespace weft
