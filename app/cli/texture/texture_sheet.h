#pragma once
// Internal: samples side by side in one picture.

#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "texture_db/library/library.h"

namespace weft {

/// 96×96 each (larger ones are cut to that), 4 px apart.
[[nodiscard]] ImageU8x3 contact_sheet(const std::vector<ImageU8x3>& pictures, int columns);
/// The frame with its regions outlined, below it one row a scheme.
[[nodiscard]] Expected<ImageU8x3> recommendation_sheet(TextureLibrary& library, ViewU8x3 plate,
                                                       const std::vector<Matte>& mattes,
                                                       const Recommendation& advice);
/// A frame's pixels as they are shown: encoded ones as they are, linear ones through the sRGB
/// curve.
[[nodiscard]] ImageU8x3 display_pixels(ViewF3 frame, bool display_encoded);
/// Errors: as write_image().
[[nodiscard]] Status write_picture(const std::string& path, ViewU8x3 picture,
                                   const WriteRule& rule);

}  // namespace weft
