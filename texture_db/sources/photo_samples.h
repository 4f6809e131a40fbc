#pragma once
// Internal: cuts samples from one picture. Shared by import and build.

#include <memory>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "texture_db/library/library.h"
#include "texture_db/sources/picture_choice.h"

namespace weft {

/// A picture and its metadata.
struct Photo {
    std::string file;  ///< To read from.
    TextureOrigin origin = TextureOrigin::kFile;
    std::string source, package, name, material, category, author, licence;
    std::vector<std::string> tags;
    bool keep_original = false;
};

/// A decoded picture with its samples. `fault`: why there are none.
struct PhotoSamples {
    std::string fault;
    ImageU8x3 picture;  ///< At the samples' scale.
    std::vector<NewTexture> samples;
};

/// Reads, selects and cuts. Never fails: `fault` has the reason. Thread-safe.
[[nodiscard]] PhotoSamples samples_of(const Photo& photo, const ChoiceRules& rules);

/// Picture files below a folder, by extension, sorted; for a file, the file itself. Errors:
/// Unreadable.
[[nodiscard]] Expected<std::vector<std::string>> pictures_below(const std::string& path);

}  // namespace weft
