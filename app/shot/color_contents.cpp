#include "app/shot/color_contents.h"

#include <algorithm>
#include <vector>

#include "engine/color/color_files.h"
#include "engine/core/hash.h"

namespace weft {

std::optional<Hash128> color_contents(const Shot& shot) {
    std::vector<ColorSpace> spaces{shot.spaces.plate, shot.spaces.working, shot.spaces.out};
    spaces.insert(spaces.end(), shot.spaces.textures.begin(), shot.spaces.textures.end());
    std::vector<Hash128> contents;
    for (const std::string& path : color_files(spaces))
        contents.push_back(shot.files->contents(path).value_or(Hash128{}));
    if (contents.empty()) return std::nullopt;
    // The order of the paths depends on the folders.
    std::sort(contents.begin(), contents.end());
    Hasher hasher;
    for (const Hash128& one : contents)
        hasher.value(one.high).value(one.low);
    return hasher.finish();
}

}  // namespace weft
