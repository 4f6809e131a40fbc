#pragma once
// The analysis on disk, found again by content.

#include <memory>
#include <string>
#include <vector>

#include "app/shot/shot.h"
#include "engine/pipeline/analysis_store.h"

namespace weft {

struct AnalysisCacheOptions {
    std::string folder;     ///< Empty: $XDG_CACHE_HOME/weft or ~/.cache/weft.
    bool keep = true;       ///< False: a private folder, removed at the end.
    bool required = false;  ///< Others read what is kept: a full disk is an error.
    std::uint64_t limit_bytes = 16ull << 30;  ///< The longest unused analyses go first.
};

/// The analysis on disk.
class AnalysisCache : public AnalysisStore {
  public:
    /// What went wrong without harm to the result, one line each. Thread-safe.
    [[nodiscard]] virtual std::vector<std::string> remarks() const = 0;
    /// The mattes that the shot was opened with in memory are on the disk now: keeps what was
    /// analysed where it is found by those files. `shot`: as in open_analysis_cache(). Regions of
    /// which a matte is still missing stay as they are. Thread-safe.
    virtual void mattes_written(const Shot& shot) = 0;
};

/// Where the cache is: `folder` itself, or what stands for an empty one; empty when there is none.
[[nodiscard]] std::string cache_root(const AnalysisCacheOptions& options);

/// Opens the cache for a shot. Each region has a folder named by the hash of all that its analysis
/// depends on (the plate's, mattes', holdouts' and motion's files by name, size and time; spaces,
/// quality, references, and in the paper mode the texture): a change of the placement or the
/// light's strength finds the analysis again, a touched file does not. A matte in memory stands for
/// itself until mattes_written(). Blobs are compressed and
/// carry a checksum; a damaged one counts as missing. Safe with several processes on one folder.
/// When the folder cannot be written, a temporary one is used and `warnings` says so; when its disk
/// is full later, the rest goes to a temporary one and the store's remarks() say so.
[[nodiscard]] Expected<std::shared_ptr<AnalysisCache>> open_analysis_cache(
    const Shot& shot, const AnalysisCacheOptions& options, std::vector<std::string>& warnings);

}  // namespace weft
