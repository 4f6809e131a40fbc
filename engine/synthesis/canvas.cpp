#include "engine/synthesis/canvas.h"

#include <algorithm>

namespace weft {

void Canvas::set_run(Vec2i p, int count, const std::uint8_t* rgb, Vec2i from) {
    while (count > 0) {
        const auto at = resolve(p.x, p.y);
        const int n = at ? std::min(count, size().width - at->x) : 1;
        if (at) {
            std::copy_n(rgb, 3 * n, pixels_.pixel(at->x, at->y));
            std::fill_n(filled_.pixel(at->x, at->y), n, std::uint8_t{1});
            std::int32_t* s = source_.pixel(at->x, at->y);
            for (int i = 0; i < n; ++i)
                s[2 * i] = from.x + i, s[2 * i + 1] = from.y;
        }
        p.x += n, from.x += n, rgb += 3 * n, count -= n;
    }
}

Block copy_block(const Canvas& canvas, const Recti& rect) {
    Block block{rect, ImageU8x3(rect.size()), Image<std::uint8_t, 1>(rect.size(), 0),
                Image<std::uint8_t, 1>(rect.size(), 0)};
    for (int y = 0; y < rect.height(); ++y) {
        // Runs that lie side by side in the canvas, too.
        for (int x = 0, n = 1; x < rect.width(); x += n, n = 1) {
            const auto p = canvas.resolve(rect.x0 + x, rect.y0 + y);
            if (!p) continue;
            n = std::min(rect.width() - x, canvas.size().width - p->x);
            std::fill_n(block.inside.pixel(x, y), n, std::uint8_t{1});
            std::copy_n(canvas.filled_row(p->y) + p->x, n, block.filled.pixel(x, y));
            std::copy_n(canvas.pixels().pixel(p->x, p->y), 3 * n, block.pixels.pixel(x, y));
        }
    }
    return block;
}

}  // namespace weft
