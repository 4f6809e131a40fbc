#pragma once
// Files that other programs save while they are shown.

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/input_file.h"

namespace weft {

/// Tells when one of a few files was saved. Looks at their stamps only, and not more often than
/// five times a second. For one thread, which may wait for a file system.
class FileWatch {
  public:
    static constexpr std::chrono::milliseconds kLook{200};

    /// From now on these files, as they are now.
    void watch(const std::vector<std::string>& paths);
    [[nodiscard]] bool empty() const { return files_.empty(); }
    /// Whether one of them is another than it was, and no longer being written: it had the same
    /// stamp at the look before. True once for each save.
    [[nodiscard]] bool saved();

  private:
    struct Watched {
        std::optional<FileStamp> known, looked;
    };
    std::map<std::string, Watched> files_;
    std::chrono::steady_clock::time_point looked_at_{};
};

}  // namespace weft
