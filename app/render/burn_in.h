#pragma once
#include <string>

#include "engine/core/image.h"

namespace weft {

/// Burns a line of text into the lower left corner of a display-encoded picture, white on a dark
/// band, 1/30 of the picture's height. Identical on every machine with the same packages.
void burn_in(ImageView<float, 3> display, const std::string& text);

}  // namespace weft
