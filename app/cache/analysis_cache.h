#pragma once
// The analysis on disk, keyed by content.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/shot/shot.h"
#include "engine/core/file_lock.h"
#include "engine/pipeline/analysis_store.h"

namespace weft {

struct AnalysisCacheOptions {
    std::string folder;     ///< Empty: $XDG_CACHE_HOME/weft or ~/.cache/weft.
    bool keep = true;       ///< False: a private folder, deleted at the end.
    bool required = false;  ///< Other processes need the cache, so a full disk is an error.
    /// Size limit; the least recently used analyses are deleted first.
    std::uint64_t limit_bytes = 16ull << 30;
};

/// One lock for each region's folder; empty: nobody is kept from anything.
using AnalysisClaim = std::vector<FileLock>;

/// The analysis on disk.
class AnalysisCache : public AnalysisStore {
  public:
    /// Problems that do not affect the result, one line each. Thread-safe.
    [[nodiscard]] virtual std::vector<std::string> remarks() const = 0;
    /// Called when in-memory mattes of the shot have been written: files their analysis under the
    /// names of the matte files. `shot`: as in open_analysis_cache(). Regions with unwritten mattes
    /// are unchanged. Thread-safe.
    virtual void mattes_written(const Shot& shot) = 0;
    /// Keeps other processes from analysing the same regions; see claim_analysis(). Nothing: one of
    /// them does so now. Never waits. Thread-safe.
    [[nodiscard]] virtual std::optional<AnalysisClaim> try_claim() const = 0;
};

/// The cache folder: `folder`, or the default for an empty one; empty if there is none.
[[nodiscard]] std::string cache_root(const AnalysisCacheOptions& options);

/// The folder of Fingerprints in a cache folder.
[[nodiscard]] std::string fingerprint_folder(const std::string& cache);
/// What is known of the inputs of shots, for OpenShotOptions::files: kept in the cache folder, or,
/// without one or with keep = false, nowhere.
[[nodiscard]] std::shared_ptr<Fingerprints> open_fingerprints(const AnalysisCacheOptions& options);

/// Opens the cache for a shot. Each region has a folder named by a hash of everything that its
/// analysis depends on: the files of plate, mattes, holdouts and motion (Fingerprints::id());
/// painted mattes by their contents, so that a project may be saved elsewhere; colour spaces,
/// quality, references; in paper mode also the texture. A changed placement or light strength
/// therefore reuses the analysis, as does a file that was rendered from and is touched later; a
/// file with other bytes does not, whatever its size and time. An in-memory matte is
/// identified by itself until mattes_written(). Blobs are compressed and have a checksum; a damaged
/// one counts as missing. Several processes may share a folder. If the folder cannot be written, a
/// temporary one is used and `warnings` says so; if its disk fills up later, the rest goes to a
/// temporary folder and remarks() says so.
[[nodiscard]] Expected<std::shared_ptr<AnalysisCache>> open_analysis_cache(
    const Shot& shot, const AnalysisCacheOptions& options, std::vector<std::string>& warnings);

}  // namespace weft
