#pragma once
// The render jobs of a session: builds their requests and reports finished ones.

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/jobs/child_jobs.h"
#include "app/session/action.h"

namespace weft {

/// Builds the request of a SubmitJob. `project` has absolute paths; `all`: the plate's frames;
/// `project_file`: absolute, empty if it was never saved.
/// Errors: Usage for an invalid frame list.
[[nodiscard]] Expected<RenderRequest> render_request(const SubmitJob& action, Project project,
                                                     const std::vector<int>& all,
                                                     const std::string& project_file = {});

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
    /// Updates jobs() and returns those of them that ended. `project`, `plate`: absolute paths of
    /// what is open, whose jobs are shown, with those that were submitted here and all that are not
    /// over; empty: none.
    [[nodiscard]] std::vector<Ended> poll(const std::string& project, const std::string& plate);
    [[nodiscard]] const std::vector<JobView>& jobs() const { return jobs_; }
    /// How long a job was to take and took, s.
    struct Timed {
        double estimated_s = 0, took_s = 0;
    };
    /// The jobs that are done and whose estimate nobody has compared yet, also those that ended
    /// while no window was open. Each is reported once, to one window.
    [[nodiscard]] std::vector<Timed> take_timed() { return std::exchange(timed_, {}); }
    [[nodiscard]] std::string log_tail(int id) const { return children_.log_tail(id); }
    /// Increases with every change of a job.
    [[nodiscard]] std::uint64_t changes() const { return children_.changes(); }

  private:
    ChildJobs children_;
    std::vector<JobView> jobs_;
    void note_times();

    std::map<int, JobState> known_;
    std::vector<Timed> timed_;
    std::set<int> compared_;
};

}  // namespace weft
