#pragma once
// Fingerprints of files on disk, one file for each folder of them.

#include <map>
#include <optional>
#include <string>

#include "engine/core/hash.h"
#include "engine/core/input_file.h"

namespace weft {

/// What is known of a file.
struct Fingerprint {
    FileStamp stamp;  ///< `device` is not kept: machines number their disks differently.
    Hash128 sample;   ///< Of some of its bytes, as hash_of_sample().
    Hash128 id;       ///< See Fingerprints::id().
    std::optional<Hash128> contents;  ///< Of all bytes, as hash_of_contents(), if they were read.
    /// They were read when a later write would have borne another time.
    bool settled = false;
};

/// By the names of the files in their folder.
using FolderFingerprints = std::map<std::string, Fingerprint>;

/// The hash of the first, the middle and the last 4096 bytes of a file. The last ones count most:
/// compressed formats have their checksums there. Thread-safe. Errors: as check_input_file().
[[nodiscard]] Expected<Hash128> hash_of_sample(const std::string& path);

/// Empty if there is none, or it is damaged. Thread-safe.
[[nodiscard]] FolderFingerprints read_fingerprints(const std::string& path);
/// Written whole or not at all, without a flush. Errors: those of the disk.
[[nodiscard]] Status write_fingerprints(const std::string& path,
                                        const FolderFingerprints& fingerprints);

}  // namespace weft
