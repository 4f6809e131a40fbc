#pragma once
// Internal: the procedural starter textures. Each is a pure function of its family and its number.

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// One starter texture, before it is rendered.
struct StarterItem {
    std::string_view family;  ///< "weave"
    int number = 0;
    std::string_view material;
};

/// All of them, in a fixed order: at least 1,600 over at least 24 materials.
[[nodiscard]] const std::vector<StarterItem>& starter_catalogue();

struct StarterPicture {
    ImageU8x3 pixels;
    std::string name;
    std::vector<std::string> tags;
};
/// `side_px` square pixels at the sample's scale: a larger side shows more of the same texture, of
/// which the sample is the top left 96×96. Deterministic; thread-safe.
[[nodiscard]] StarterPicture make_starter(const StarterItem& item, int side_px);

/// "weave/12", and back. Errors: Unreadable for a source that names no starter texture.
[[nodiscard]] std::string starter_source(const StarterItem& item);
[[nodiscard]] Expected<ImageU8x3> starter_original(const std::string& source);

}  // namespace weft
