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
    int looked_wrong = 0;   ///< Left out because a person saw no material in them.
    int refused_paths = 0;  ///< Archive entries whose paths are unsafe.
};

/// Looks through `unpacked` (and the zip and pk3 archives in it, whose pictures are written below
/// `extracted`). Licences are read from usr/share/doc/*/copyright. Errors: Unreadable, NoSpace.
[[nodiscard]] Expected<PackagePictures> find_package_pictures(const std::string& package,
                                                              const std::string& unpacked,
                                                              const std::string& extracted,
                                                              const CancelToken& cancel);

/// Whether a path speaks of a thing (a sign, a door, a screen) rather than of a surface.
[[nodiscard]] bool names_a_thing(const std::string& path);

}  // namespace weft
