#pragma once
// Internal: Debian packages as sources of pictures: found by name, downloaded, unpacked without
// being installed.

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/cancel.h"
#include "engine/core/error.h"

namespace weft {

struct PackageInfo {
    std::string name, version;
    std::int64_t download_bytes = 0, unpacked_bytes = 0;
};

/// Errors: Unreadable when apt does not know the package.
[[nodiscard]] Expected<PackageInfo> find_package_info(const std::string& name);

/// Downloads into `folder` unless it is there whole; returns the path of the .deb. Errors:
/// Unreadable when it cannot be reached, NoSpace, cancellation.
[[nodiscard]] Expected<std::string> download_package(const PackageInfo& package,
                                                     const std::string& folder,
                                                     const CancelToken& cancel);
/// Unpacks into `folder`, which is made. Errors as above.
[[nodiscard]] Status unpack_package(const std::string& deb, const std::string& folder,
                                    const CancelToken& cancel);

/// Runs a program without a shell and returns what it printed (at most 1 MiB). Errors: Unreadable
/// with its last line when it fails; cancellation ends it.
[[nodiscard]] Expected<std::string> run_program(const std::vector<std::string>& arguments,
                                                const std::string& folder,
                                                const CancelToken& cancel);

}  // namespace weft
