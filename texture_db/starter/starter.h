#pragma once
// Internal: the procedural starter textures. Each is a pure function of its family and its number.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/geometry.h"
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

/// The unit that a pattern repeats, such as a brick with the offset of the next course: every whole
/// combination of `steps` (px) maps the pattern onto itself, chance in tone and shape apart.
struct StarterUnit {
    /// 2; 1 for stripes, whose step is their normal and which may move along themselves; 0 for a
    /// texture without a unit, or of which it is not known.
    int count = 0;
    std::array<Vec2, 2> steps{};
};

struct StarterPicture {
    ImageU8x3 pixels;
    std::string name;
    std::vector<std::string> tags;
    StarterUnit unit;
};
/// `side_px` square pixels at the sample's scale: a larger side shows more of the same texture, of
/// which the sample is the top left 96×96. Deterministic; thread-safe.
[[nodiscard]] StarterPicture make_starter(const StarterItem& item, int side_px);

/// "weave/12", and back. Errors: Unreadable for a source that names no starter texture.
[[nodiscard]] std::string starter_source(const StarterItem& item);
[[nodiscard]] Expected<ImageU8x3> starter_original(const std::string& source);

}  // namespace weft
