#pragma once
// Render jobs as child processes: `weft render` on a snapshot of the project. A crash of either
// side does not affect the other, and a render continues when the editor is closed.

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/base/picture.h"
#include "app/project/project.h"
#include "engine/core/error.h"

namespace weft {

enum class JobState : std::uint8_t { kWaiting, kRunning, kPaused, kDone, kCancelled, kFailed };

struct RenderRequest {
    Project project;    ///< With absolute paths.
    std::string label;  ///< "Frames 1001-1048 to out/####.png"
    std::vector<int> frames;
    bool overwrite = false, skip_existing = false;
    double estimated_s = 0;  ///< Estimated time, s; 0: not known.
    std::string backend = "auto";
};

struct JobView {
    int id = 0;
    JobState state = JobState::kWaiting;
    std::string label, output, stage, error;
    int done = 0, total = 0;  ///< Finished frames; frames of the analysis while `stage` says so.
    int newest_frame = 0;     ///< 0: none yet.
    bool has_frame = false;
    double elapsed_s = 0, left_s = 0, frames_per_minute = 0;
    double estimated_s = 0;  ///< As submitted; 0 after a pause or retry, when it no longer holds.
    PicturePtr thumbnail;    ///< Thumbnail of the newest frame.
    std::string log_path, movie;
    std::string plate;  ///< Of its shot, absolute.
};

/// Runs one job at a time; the others wait in order. Thread-safe; does not block.
class ChildJobs {
  public:
    /// `program`: the weft program. `folder`: for snapshots and logs; created if missing.
    ChildJobs(std::string program, std::string folder);
    /// Does not stop running jobs; see cancel_all().
    ~ChildJobs();

    /// Adds a job and returns its id. Errors: the snapshot cannot be written.
    [[nodiscard]] Expected<int> submit(const RenderRequest& request);
    void cancel(int id);
    void pause(int id);
    void resume(int id);
    /// Runs a job again and keeps existing frames.
    void retry(int id);
    /// Removes a finished job from the list.
    void remove(int id);
    void cancel_all();

    [[nodiscard]] std::vector<JobView> views() const;
    [[nodiscard]] bool busy() const;
    /// Increases with every change.
    [[nodiscard]] std::uint64_t changes() const;
    /// The last lines of a job's log.
    [[nodiscard]] std::string log_tail(int id, std::size_t most_bytes = 8192) const;

  private:
    struct Job;
    struct Shared;
    static void run(const std::shared_ptr<Shared>& shared, const std::shared_ptr<Job>& job);
    static void start_next(const std::shared_ptr<Shared>& shared);

    std::shared_ptr<Shared> shared_;
};

}  // namespace weft
