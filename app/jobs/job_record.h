#pragma once
// A render job as the queue's folder keeps it, so that it survives the window that submitted it and
// every window shows it. docs/FORMATS.md describes the files.

#include <string>
#include <vector>

#include "app/jobs/job_process.h"
#include "app/jobs/job_view.h"
#include "engine/core/error.h"

namespace weft {

struct JobRecord {
    std::string name;  ///< Of its files, without ending.
    JobState state = JobState::kWaiting;
    double place = 0;  ///< Jobs that wait are begun in this order.
    std::string label, project, plate, output, movie, backend = "auto";
    bool overwrite = false, skip_existing = false;
    bool cancelled = false;  ///< It was told to end.
    int total = 0;           ///< Frames.
    double estimated_s = 0;  ///< 0: not known.
    JobProcess process;      ///< Of a running or paused job.
    // On the clock of the system, s since 1970; 0: not yet.
    double begun_s = 0, paused_at_s = 0;
    double paused_s = 0;   ///< All pauses that have ended.
    double elapsed_s = 0;  ///< Of a job that is over, without pauses.
    int newest_frame = 0;
    bool has_frame = false;
    std::string error;
    JobProblem problem;
    bool operator==(const JobRecord&) const = default;
};

/// The files of a job in the queue's folder.
struct JobFiles {
    explicit JobFiles(const std::string& folder, const std::string& name);
    std::string record;    ///< JSON.
    std::string snapshot;  ///< The project as it was submitted.
    std::string log, progress;
    std::string answer;  ///< What `weft render` says in the end; none if it was killed.
    void remove() const;
    /// Removes what an earlier run of the job has left.
    void remove_results() const;
};

/// Errors: Unreadable (missing, damaged, or of a later version).
[[nodiscard]] Expected<JobRecord> read_job(const std::string& folder, const std::string& name);
/// Atomic. Errors: as write_file_atomically().
[[nodiscard]] Status write_job(const std::string& folder, const JobRecord& record);
/// All that can be read, by place.
[[nodiscard]] std::vector<JobRecord> read_jobs(const std::string& folder);

}  // namespace weft
