#pragma once
// Internal: the pictures of an unpacked Debian package that may be textures, by their names.

#include <string>
#include <vector>

#include "engine/core/cancel.h"
#include "engine/core/error.h"
#include "texture_db/sources/photo_samples.h"

namespace weft {

struct PackagePictures {
    std::vector<Photo> photos;  ///< Sorted by source.
    int not_named = 0;
    int looked_wrong = 0;   ///< Skipped because a person found no material in them.
    int refused_paths = 0;  ///< Archive entries whose paths are unsafe.
};

/// Searches `unpacked` and its zip and pk3 archives, whose pictures are extracted below
/// `extracted`. Licences are read from usr/share/doc/*/copyright. Errors: Unreadable, NoSpace;
/// cancellation.
[[nodiscard]] Expected<PackagePictures> find_package_pictures(const std::string& package,
                                                              const std::string& unpacked,
                                                              const std::string& extracted,
                                                              const CancelToken& cancel);

/// Returns true if a path names an object (a sign, a door, a screen) instead of a surface.
[[nodiscard]] bool names_an_object(const std::string& path);

}  // namespace weft
