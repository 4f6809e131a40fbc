#pragma once
// A matte of a rectangle.

#include <algorithm>

#include "engine/core/geometry.h"
#include "engine/core/image.h"

namespace weft::test {

/// 255 inside `area`, which lies within `size`.
inline Matte filled(const Recti& area, Size size) {
    Matte out(size);
    for (int y = area.y0; y < area.y1; ++y)
        std::fill(out.row(y) + area.x0, out.row(y) + area.x1, std::uint8_t{255});
    return out;
}

}  // namespace weft::test
