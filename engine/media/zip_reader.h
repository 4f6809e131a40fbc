#pragma once
// Internal: reads untrusted zip files (and .pk3, which are zip files).

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/error.h"

struct zip;

namespace weft {

struct ZipEntry {
    std::string path;  ///< As in the archive; safe: see is_safe_path().
    std::uint64_t index = 0, bytes = 0;
};

/// Relative, without "..", drive letters, backslashes, control characters or empty parts.
[[nodiscard]] bool is_safe_path(const std::string& path);

/// Also reads archives of more than 65,535 entries or 4 GiB (zip64). Not thread-safe.
class ZipReader {
  public:
    /// Errors: as check_input_file(); Unreadable (no zip, damaged, more than a million entries,
    /// split archives), NoSpace.
    [[nodiscard]] static Expected<ZipReader> open(const std::string& path);
    /// Plain files with safe paths.
    [[nodiscard]] const std::vector<ZipEntry>& entries() const { return entries_; }
    /// Paths of the other entries: they lead out of the folder, are too large, encrypted or
    /// compressed by another method than deflate.
    [[nodiscard]] const std::vector<std::string>& refused() const { return refused_; }
    /// Errors: Unreadable (damaged, wrong checksum, wrong size), NoSpace.
    [[nodiscard]] Expected<std::string> read(const ZipEntry& entry);

  private:
    struct Close {
        void operator()(zip* archive) const;
    };

    struct Source;
    struct FreeSource {
        void operator()(Source* source) const;
    };

    std::string path_;
    std::unique_ptr<Source, FreeSource> source_;  // outlives the archive
    std::unique_ptr<zip, Close> archive_;
    std::vector<ZipEntry> entries_;
    std::vector<std::string> refused_;
};

}  // namespace weft
