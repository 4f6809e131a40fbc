#pragma once
// The thread behind ChildJobs: it reads the queue's folder, carries out commands, begins the next
// job and follows those that run. Several processes may work on one folder; what changes a record
// is done under the folder's lock, with the record read anew.

#include <sys/types.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/jobs/job_progress.h"
#include "app/jobs/job_record.h"
#include "engine/core/file_lock.h"
#include "engine/core/stopwatch.h"

namespace weft {

/// A job as this process knows it.
struct KnownJob {
    JobRecord record;
    JobView view;
    std::optional<JobProgress> progress;
    pid_t child = -1;  ///< This process has begun it and must ask for its status.
    std::optional<Clock::time_point> ended_at;  ///< When its process was first found to have ended.
    Clock::time_point pictured_at;              ///< When its thumbnail was last read.
    bool thumbnail_tried = false;
};

/// Changes records, which were just read under the lock; one with an empty name is removed.
using JobCommandFn = std::function<void(std::vector<JobRecord>&)>;

/// What ChildJobs and its thread share.
struct JobsShared {
    std::string program, folder;
    mutable std::mutex mutex;  ///< Protects everything below.
    std::condition_variable wake;
    std::vector<std::shared_ptr<KnownJob>> jobs;  ///< By place.
    std::deque<JobCommandFn> commands;
    std::set<std::string> mine;  ///< Names.
    std::uint64_t changes = 0;
    int last_id = 0;
    bool closing = false;
};

/// Shows what the record says; what the renderer says of its work is kept.
void show_record(const JobRecord& record, const JobFiles& files, JobView& view);

/// The clock of the records, s since 1970.
[[nodiscard]] double unix_time_s();

/// The lock of a queue's folder. Errors: as FileLock::take(); the folder cannot be written.
[[nodiscard]] Expected<FileLock> lock_queue(const std::string& folder);

/// Belongs to the thread that calls run().
class JobWorker {
  public:
    explicit JobWorker(JobsShared& shared) : shared_(shared) {}
    /// Works until `closing`; what was commanded before is still carried out.
    void run();

  private:
    void carry_out();
    void read_folder();
    void take(const std::vector<JobRecord>& records);
    [[nodiscard]] std::shared_ptr<KnownJob> known(const JobRecord& record);
    /// Whether some job runs or is paused.
    [[nodiscard]] bool follow_all();
    void follow(KnownJob& job);
    [[nodiscard]] bool has_ended(KnownJob& job, std::optional<bool>& good) const;
    void finish(KnownJob& job, std::optional<bool> good);
    /// Whether some job runs now, or may be found to at once.
    [[nodiscard]] bool start_next();
    [[nodiscard]] pid_t start(const JobRecord& record) const;
    void picture_one();
    void picture(KnownJob& job);
    [[nodiscard]] std::vector<std::shared_ptr<KnownJob>> jobs() const;

    JobsShared& shared_;
    std::optional<std::filesystem::file_time_type> folder_changed_;
    Clock::time_point read_at_;
};

}  // namespace weft
