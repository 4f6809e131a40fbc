#pragma once
// The analysis on disk, found again by content.

#include <memory>
#include <string>
#include <vector>

#include "app/session/shot.h"
#include "engine/pipeline/analysis_store.h"

namespace weft {

struct AnalysisCacheOptions {
    std::string folder;                       ///< Empty: $XDG_CACHE_HOME/weft or ~/.cache/weft.
    bool keep = true;                         ///< False: a private folder, removed at the end.
    std::uint64_t limit_bytes = 16ull << 30;  ///< The longest unused analyses go first.
};

/// Where the cache is: `folder` itself, or what stands for an empty one; empty when there is none.
[[nodiscard]] std::string cache_root(const AnalysisCacheOptions& options);

/// Opens the cache for a shot. Each region has a folder named by the hash of all that its analysis
/// depends on (the plate's, mattes', holdouts' and motion's files by name, size and time; spaces,
/// quality, references, and in the paper mode the texture): a change of the placement or the
/// light's strength finds the analysis again, a touched file does not. Blobs are compressed and
/// carry a checksum; a damaged one counts as missing. Safe with several processes on one folder.
/// When the folder cannot be written, a temporary one is used and `warnings` says so.
[[nodiscard]] Expected<std::shared_ptr<AnalysisStore>> open_analysis_cache(
    const Shot& shot, const AnalysisCacheOptions& options, std::vector<std::string>& warnings);

}  // namespace weft
