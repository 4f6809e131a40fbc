#pragma once
// The pictures of an anamorphic plate with square pixels, for what measures lengths and angles.

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "engine/core/image.h"
#include "engine/core/pixel_aspect.h"

namespace weft {

namespace impl {

// `by`: how many times as wide, by linear interpolation along the rows.
template <class T, int C>
[[nodiscard]] Image<T, C> stretched(const Image<T, C>& from, float by, Size size) {
    Image<T, C> out(size);
    for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
            const float at = std::clamp((static_cast<float>(x) + 0.5f) / by - 0.5f, 0.0f,
                                        static_cast<float>(from.width() - 1));
            const int left = static_cast<int>(at), right = std::min(left + 1, from.width() - 1);
            const float share = at - static_cast<float>(left);
            const T *a = from.pixel(left, y), *b = from.pixel(right, y);
            for (int c = 0; c < C; ++c) {
                const auto low = static_cast<float>(a[c]), high = static_cast<float>(b[c]);
                const float value = low + share * (high - low);
                if constexpr (std::is_integral_v<T>)
                    out.pixel(x, y)[c] = static_cast<T>(std::lround(value));
                else
                    out.pixel(x, y)[c] = value;
            }
        }
    }
    return out;
}

}  // namespace impl

/// A picture unsqueezed, of PixelAspect::unsqueezed(size), by linear interpolation along the rows;
/// the same picture if its pixels are square. What is not finite stays so with its neighbours.
template <class T, int C>
[[nodiscard]] Image<T, C> unsqueezed(Image<T, C> squeezed, PixelAspect aspect) {
    if (aspect.square() || squeezed.empty()) return squeezed;
    return impl::stretched(squeezed, aspect.ratio(), aspect.unsqueezed(squeezed.size()));
}

/// The way back, to a picture of the plate's size.
template <class T, int C>
[[nodiscard]] Image<T, C> squeezed(Image<T, C> unsqueezed, PixelAspect aspect, Size plate) {
    if (aspect.square()) return unsqueezed;
    return impl::stretched(unsqueezed, 1 / aspect.ratio(), plate);
}

}  // namespace weft
