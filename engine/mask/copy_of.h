#pragma once
#include <algorithm>
#include <cstddef>

#include "engine/core/image.h"

namespace weft {

/// An image of its own with what a view shows.
template <class T, int C>
[[nodiscard]] Image<T, C> copy_of(ImageView<const T, C> v) {
    Image<T, C> result(v.size());
    for (int y = 0; y < v.height(); ++y)
        std::copy(v.row(y), v.row(y) + static_cast<std::ptrdiff_t>(v.width()) * C, result.row(y));
    return result;
}

/// Writes `part` over the pixels of `into` that begin at (at.x0, at.y0).
template <class T, int C>
void paste(Image<T, C>& into, const Image<T, C>& part, const Recti& at) {
    for (int y = 0; y < part.height(); ++y)
        std::copy(part.row(y), part.row(y) + part.stride(), into.pixel(at.x0, at.y0 + y));
}

}  // namespace weft
