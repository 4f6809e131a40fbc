#pragma once
// The larger picture that a library's sample was cut from.

#include <string>

#include "engine/core/error.h"

namespace weft {

struct LargerOriginal {
    std::string path;  ///< Of the file that was written.
    float scale = 1;   ///< Its pixels for one of the sample.
};

/// How many pixels of the larger picture one of the sample stands for; 1 where there is none, or it
/// only shows more of the surface. `id`: 32 digits. Errors: Unreadable for the library.
[[nodiscard]] Expected<float> original_scale(const std::string& library_path,
                                             const std::string& id);

/// Writes the piece of the original that `sample_path` (db_ID.png beside a project, or "db:ID")
/// shows, or as much of the whole as 1024 px hold, to `folder` with its credit. Errors: Usage when
/// the sample is no library's or has no larger original; those of the library and the folder.
[[nodiscard]] Expected<LargerOriginal> keep_larger_original(const std::string& library_path,
                                                            const std::string& sample_path,
                                                            const std::string& folder);

}  // namespace weft
