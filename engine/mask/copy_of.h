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

}  // namespace weft
