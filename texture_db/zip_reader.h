#pragma once
// Internal: reads zip files (and .pk3, which are zip files) without trusting them.

#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/error.h"

namespace weft {

struct ZipEntry {
    std::string path;  ///< As in the archive; safe: see is_safe_path().
    std::uint64_t packed_bytes = 0, bytes = 0, offset = 0;
    int method = 0;
    std::uint32_t crc = 0;
};

/// Relative, without "..", drive letters, backslashes, control characters or empty parts.
[[nodiscard]] bool is_safe_path(const std::string& path);

/// Not thread-safe.
class ZipReader {
  public:
    /// Errors: Unreadable (no zip, damaged, more than a million entries, zip64 or split archives).
    [[nodiscard]] static Expected<ZipReader> open(const std::string& path);
    /// Plain files with safe paths. Others are counted in refused().
    [[nodiscard]] const std::vector<ZipEntry>& entries() const { return entries_; }
    /// Entries whose path would climb out of the folder or that are too large.
    [[nodiscard]] const std::vector<std::string>& refused() const { return refused_; }
    /// Errors: Unreadable (damaged, wrong checksum, larger than it says, encrypted).
    [[nodiscard]] Expected<std::string> read(const ZipEntry& entry);

  private:
    std::string path_;
    std::unique_ptr<std::ifstream> file_;
    std::vector<ZipEntry> entries_;
    std::vector<std::string> refused_;
};

}  // namespace weft
