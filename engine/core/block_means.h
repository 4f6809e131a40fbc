#pragma once
// Pictures at a whole fraction of their size.

#include <algorithm>
#include <type_traits>

#include "engine/core/image.h"
#include "engine/core/parallel.h"

namespace weft {

/// The size of a picture of which blocks of factor × factor pixels become one; the last row and
/// column may be of smaller blocks.
[[nodiscard]] inline Size blocks_of(Size size, int factor) {
    return {(size.width + factor - 1) / factor, (size.height + factor - 1) / factor};
}

/// The mean of each block, channel by channel; of whole numbers rounded down. `factor` ≥ 1.
template <class T, int C>
[[nodiscard]] Image<T, C> block_means(const Image<T, C>& picture, int factor) {
    using Sum = std::conditional_t<std::is_integral_v<T>, int, T>;
    Image<T, C> out(blocks_of(picture.size(), factor));
    parallel_rows(out.height(), 16, [&](int first, int last) {
        for (int y = first; y < last; ++y) {
            const int y0 = y * factor, y1 = std::min(y0 + factor, picture.height());
            for (int x = 0; x < out.width(); ++x) {
                const int x0 = x * factor, x1 = std::min(x0 + factor, picture.width());
                Sum sum[C] = {};
                for (int v = y0; v < y1; ++v) {
                    const T* p = picture.pixel(x0, v);
                    for (int u = x0; u < x1; ++u, p += C)
                        for (int c = 0; c < C; ++c)
                            sum[c] += static_cast<Sum>(p[c]);
                }
                const auto count = static_cast<Sum>((y1 - y0) * (x1 - x0));
                for (int c = 0; c < C; ++c)
                    out.pixel(x, y)[c] = static_cast<T>(sum[c] / count);
            }
        }
    });
    return out;
}

}  // namespace weft
