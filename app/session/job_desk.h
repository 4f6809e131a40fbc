#pragma once
// The renders of a session: what is asked of them, and what is to be said when one ends.

#include <map>
#include <string>
#include <vector>

#include "app/session/action.h"
#include "app/session/child_jobs.h"

namespace weft {

/// What a SubmitJob asks for. `project` has absolute paths; `all`: the plate's frames. Errors:
/// Usage for a frame list that cannot be read.
[[nodiscard]] Expected<RenderRequest> render_request(const SubmitJob& action, Project project,
                                                     const std::vector<int>& all);

/// One thread, but for submit().
class JobDesk {
  public:
    /// As ChildJobs.
    JobDesk(std::string program, std::string folder);

    /// The new job's id. Thread-safe. Errors: as ChildJobs::submit().
    [[nodiscard]] Expected<int> submit(const RenderRequest& request);
    void command(const CommandJob& action);

    /// A job that ended since the last look.
    struct Ended {
        bool failed = false;
        std::string label, error;
    };
    /// Looks at the jobs; jobs() is as of then.
    [[nodiscard]] std::vector<Ended> poll();
    [[nodiscard]] const std::vector<JobView>& jobs() const { return jobs_; }
    [[nodiscard]] std::string log_tail(int id) const { return children_.log_tail(id); }
    /// Grows with everything that jobs report.
    [[nodiscard]] std::uint64_t changes() const { return children_.changes(); }

  private:
    ChildJobs children_;
    std::vector<JobView> jobs_;
    std::map<int, JobState> known_;
};

}  // namespace weft
