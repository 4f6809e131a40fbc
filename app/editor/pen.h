#pragma once
#include <memory>

#include "ui/pen.h"

namespace weft {

/// The pens of the desktop, or null where it does not tell about them.
[[nodiscard]] std::unique_ptr<PenSource> open_pen();

}  // namespace weft
