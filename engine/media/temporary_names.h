#pragma once
// Internal: names of files that are being written, distinct from those that a killed run left.

#include <sys/types.h>

#include <map>
#include <mutex>
#include <string>

namespace weft {

/// ".plate.0012.weft-HOST-PID-COUNT.png" for plate.0012.png: hidden, with host and process, with
/// the same extension, and unique within a process.
[[nodiscard]] std::string temporary_name(const std::string& file_name);

/// Temporaries that this process is writing, as opposed to those of an earlier process with the
/// same number (containers reuse them). Thread-safe.
class LiveNames {
  public:
    /// Never destroyed, because abandon() may run while the process ends.
    static LiveNames& instance();
    void add(const std::string& path);
    void remove(const std::string& path);
    [[nodiscard]] bool has(const std::string& file_name);
    /// Removes all of them and prevents new ones.
    void abandon();

  private:
    std::mutex mutex_;
    std::map<std::string, std::string> paths_;  // by file name, which is of this process alone
};

/// Removes from `folder` the temporaries of the kind (S_IFREG, S_IFDIR) that no process writes any
/// more.
void remove_stale(const std::string& folder, mode_t kind);

}  // namespace weft
