#pragma once
// Internal: Debian packages as sources of pictures: looked up by name, downloaded, and unpacked
// without installation.

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

/// Errors: Unreadable if apt does not know the package; Usage if `name` is not a package name.
[[nodiscard]] Expected<PackageInfo> find_package_info(const std::string& name);

/// Downloads into `folder` unless the complete file is there; returns the path of the .deb. Errors:
/// Unreadable if it cannot be reached, NoSpace, cancellation.
[[nodiscard]] Expected<std::string> download_package(const PackageInfo& package,
                                                     const std::string& folder,
                                                     const CancelToken& cancel);
/// Unpacks into `folder`, which is created. Errors as above.
[[nodiscard]] Status unpack_package(const std::string& deb, const std::string& folder,
                                    const CancelToken& cancel);

/// Runs a program without a shell and returns its output (at most 1 MiB). Errors: Unreadable with
/// its last line if it fails; cancellation ends it.
[[nodiscard]] Expected<std::string> run_program(const std::vector<std::string>& arguments,
                                                const std::string& folder,
                                                const CancelToken& cancel);

}  // namespace weft
