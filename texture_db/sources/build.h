#pragma once
// Builds the full library on the user's machine from Debian packages.

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/cancel.h"
#include "engine/core/error.h"
#include "engine/core/progress.h"
#include "texture_db/library/library.h"

namespace weft {

[[nodiscard]] const std::vector<std::string>& default_texture_packages();

struct BuildOptions {
    std::vector<std::string> packages = default_texture_packages();
    std::string work_folder;  ///< Downloads and unpacked files; empty:
                              ///< $XDG_CACHE_HOME/weft/texture-packages.
    int most_per_picture = 30;
    bool starter = true;
    bool keep_downloads = false;
};

struct BuildEstimate {
    struct Package {
        std::string name, version;
        std::int64_t download_bytes = 0;
        bool known = true;
        std::string fault;
    };
    std::vector<Package> packages;
    std::int64_t download_bytes = 0, disk_bytes = 0, free_bytes = 0;
    double minutes = 0;  ///< Without the download.
};
/// What a build will need. Errors: those of the folder; a package's own fault is in its entry.
[[nodiscard]] Expected<BuildEstimate> estimate_build(const BuildOptions& options);

struct BuildReport {
    int pictures = 0, samples = 0;
    int not_named = 0;     ///< Pictures whose names contain no material.
    int looked_wrong = 0;  ///< Pictures that a person found to show no material.
    int duplicates = 0;    ///< Pictures and samples added before.
    int outliers = 0;      ///< Samples that look like another material than their name.
    std::vector<std::pair<std::string, int>> refused;  ///< Reason, and number of pictures.
    std::vector<std::string> unreachable;              ///< Packages that could not be downloaded.
    double seconds = 0;
};

/// Downloads, unpacks, selects, adds and trains. After an interruption the next call continues. A
/// package that cannot be reached is reported and tried again next time. Errors: NoSpace, before
/// anything is downloaded, if the disk is too small; those of the library; cancellation.
[[nodiscard]] Expected<BuildReport> build_library(TextureLibrary& library,
                                                  const BuildOptions& options,
                                                  const CancelToken& cancel = {},
                                                  const ProgressFn& progress = {});

}  // namespace weft
