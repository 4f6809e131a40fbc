#pragma once
// Internal: one picture becomes samples. Shared by import and build.

#include <memory>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "texture_db/library/library.h"
#include "texture_db/sources/picture_choice.h"

namespace weft {

/// A picture and what is known of it.
struct Photo {
    std::string file;  ///< To read from.
    TextureOrigin origin = TextureOrigin::kFile;
    std::string source, package, name, material, category, author, licence;
    std::vector<std::string> tags;
    bool keep_original = false;
};

/// A decoded picture on its way. `fault` says why there are no samples.
struct PhotoSamples {
    std::string fault;
    ImageU8x3 picture;  ///< At the samples' scale.
    std::vector<NewTexture> samples;
};

/// Reads, chooses and cuts. Never fails: what is wrong stands in `fault`. Thread-safe.
[[nodiscard]] PhotoSamples samples_of(const Photo& photo, const ChoiceRules& rules);

/// Files below a folder that have a picture's extension, sorted; a file is itself.
[[nodiscard]] Expected<std::vector<std::string>> pictures_below(const std::string& path);

}  // namespace weft
