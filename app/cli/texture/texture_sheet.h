#pragma once
// Internal: contact sheets of samples.

#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "texture_db/library/library.h"

namespace weft {

/// Samples of 96×96 px (larger ones are cropped), 4 px apart.
[[nodiscard]] ImageU8x3 contact_sheet(const std::vector<ImageU8x3>& pictures, int columns);
/// The frame with its regions outlined, and one row per set of suggestions below it.
[[nodiscard]] Expected<ImageU8x3> recommendation_sheet(TextureLibrary& library, ViewU8x3 plate,
                                                       const std::vector<Matte>& mattes,
                                                       const Recommendation& advice);
/// A frame's pixels for display: encoded ones unchanged, linear ones through the sRGB curve.
[[nodiscard]] ImageU8x3 display_pixels(ViewF3 frame, bool display_encoded);
/// Errors: as write_image().
[[nodiscard]] Status write_picture(const std::string& path, ViewU8x3 picture,
                                   const WriteRule& rule);

}  // namespace weft
