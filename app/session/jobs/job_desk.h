#pragma once
// The render jobs of a session: builds their requests and reports finished ones.

#include <map>
#include <string>
#include <vector>

#include "app/jobs/child_jobs.h"
#include "app/session/action.h"

namespace weft {

/// Builds the request of a SubmitJob. `project` has absolute paths; `all`: the plate's frames.
/// Errors: Usage for an invalid frame list.
[[nodiscard]] Expected<RenderRequest> render_request(const SubmitJob& action, Project project,
                                                     const std::vector<int>& all);

/// Belongs to one thread, except for submit().
class JobDesk {
  public:
    /// As ChildJobs().
    JobDesk(std::string program, std::string folder);

    /// Submits a job and returns its id. Thread-safe. Errors: as ChildJobs::submit().
    [[nodiscard]] Expected<int> submit(const RenderRequest& request);
    void command(const CommandJob& action);

    /// A job that ended since the last poll().
    struct Ended {
        bool failed = false;
        std::string label, error;
    };
    /// Updates jobs() and returns the jobs that ended.
    [[nodiscard]] std::vector<Ended> poll();
    [[nodiscard]] const std::vector<JobView>& jobs() const { return jobs_; }
    [[nodiscard]] std::string log_tail(int id) const { return children_.log_tail(id); }
    /// Increases with every change of a job.
    [[nodiscard]] std::uint64_t changes() const { return children_.changes(); }

  private:
    ChildJobs children_;
    std::vector<JobView> jobs_;
    std::map<int, JobState> known_;
};

}  // namespace weft
