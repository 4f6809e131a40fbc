#pragma once
#include <memory>

#include "ui/input/pen.h"

namespace weft {

/// Opens the tablet pens of the desktop; null if it does not report them.
[[nodiscard]] std::unique_ptr<PenSource> open_pen();

}  // namespace weft
