#pragma once
#include <string>

#include "engine/core/image.h"

namespace weft {

/// Writes a line of text into the picture's lower left corner, white on a dark band, its height a
/// thirtieth of the picture's. Display-encoded. The same on every machine with the same packages.
void burn_in(ImageView<float, 3> display, const std::string& text);

}  // namespace weft
