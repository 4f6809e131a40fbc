#pragma once
#include <optional>

#include "app/shot/shot.h"

namespace weft {

/// A hash of what the shot's colour spaces are read from: the OpenColorIO config and those of its
/// look-up tables that convert between them, by their contents. Nothing if all are built in.
[[nodiscard]] std::optional<Hash128> color_contents(const Shot& shot);

}  // namespace weft
