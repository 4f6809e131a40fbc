#pragma once
// Crash recovery: after every change a snapshot of the document is written in the background,
// atomically and synced.

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/project/codec/update_project.h"
#include "app/project/project.h"
#include "engine/core/error.h"

namespace weft {

/// A document with unsaved changes of an editor that crashed.
struct RecoveredProject {
    std::string file;                    ///< The snapshot itself.
    std::string project_path;            ///< Path of the project; empty: never saved.
    std::string when;                    ///< "21 November at 14:02"
    Project project;                     ///< With absolute paths.
    std::optional<ProjectOnDisk> known;  ///< As Snapshot's.
};

/// What is written after a change.
struct Snapshot {
    Project project;           ///< With absolute paths.
    std::string project_path;  ///< Empty: never saved.
    /// What the project's file held when it was opened or last saved; none: never saved.
    std::optional<ProjectOnDisk> known = {};
};

class RecoveryWriter {
  public:
    /// `before_writing` is called in the background before each snapshot, to write files that the
    /// snapshot refers to.
    RecoveryWriter(const std::string& folder, std::function<void()> before_writing);
    ~RecoveryWriter();  ///< Writes a pending snapshot and keeps it.

    /// Schedules a snapshot; it replaces a pending one.
    void note(Snapshot snapshot);
    /// Deletes the snapshot: the document was saved or closed on purpose.
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
    std::optional<Snapshot> next_;
    bool clear_ = false, busy_ = false, stop_ = false;
    std::string error_;
    std::thread thread_;
};

/// Finds the snapshots of editors that no longer run, newest first.
[[nodiscard]] std::vector<RecoveredProject> find_recoverable(const std::string& folder);

}  // namespace weft
