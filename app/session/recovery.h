#pragma once
// What survives a crash: a snapshot of the document after every change, written in the background,
// whole or not at all, and synced.

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/project/project.h"
#include "engine/core/error.h"

namespace weft {

/// A document that an editor left without saving.
struct RecoveredProject {
    std::string file;          ///< The snapshot itself.
    std::string project_path;  ///< Of the project it belongs to; empty: never saved.
    std::string when;          ///< "21 November at 14:02"
    Project project;           ///< With absolute paths.
};

class RecoveryWriter {
  public:
    /// `before_writing` is called in the background before each snapshot: what the snapshot refers
    /// to must be on the disk first.
    RecoveryWriter(std::string folder, std::function<void()> before_writing);
    ~RecoveryWriter();  ///< Writes what is still to be written, and keeps it.

    /// The newest snapshot replaces one that has not been written yet. `project`: absolute paths.
    void note(Project project, std::string project_path);
    /// There is nothing to be recovered any more: saved, or closed on purpose.
    void clear();
    /// Waits until the last snapshot is on the disk.
    void flush();
    [[nodiscard]] std::string take_error();

  private:
    void work();

    const std::string file_;
    const std::function<void()> before_writing_;
    std::mutex mutex_;
    std::condition_variable wake_, done_;
    std::optional<std::pair<Project, std::string>> next_;
    bool clear_ = false, busy_ = false, stop_ = false;
    std::string error_;
    std::thread thread_;
};

/// What editors that no longer run have left in this folder, the newest first.
[[nodiscard]] std::vector<RecoveredProject> find_recoverable(const std::string& folder);

}  // namespace weft
