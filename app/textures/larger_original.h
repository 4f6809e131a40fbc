#pragma once
// The larger original image that a library sample was cut from.

#include <string>

#include "engine/core/error.h"

namespace weft {

struct LargerOriginal {
    std::string path;  ///< Path of the written file.
    float scale = 1;   ///< Its pixels per pixel of the sample.
};

/// Pixels of the original per pixel of the sample; 1 if there is no original or it only shows a
/// larger area. `id`: 32 digits. Errors: Unreadable for the library.
[[nodiscard]] Expected<float> original_scale(const std::string& library_path,
                                             const std::string& id);

/// Writes the part of the original that `sample_path` (db_ID.png beside a project, or "db:ID")
/// shows, enlarged to at most 1024 px, to `folder` with its credit. Errors: Usage when the sample
/// is not from a library or has no larger original; those of the library and the folder.
[[nodiscard]] Expected<LargerOriginal> keep_larger_original(const std::string& library_path,
                                                            const std::string& sample_path,
                                                            const std::string& folder);

}  // namespace weft
