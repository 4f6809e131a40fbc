#include "engine/synthesis/canvas.h"

#include <algorithm>

namespace weft {

std::optional<Vec2i> Canvas::first_unfilled() {
    for (; scan_.y < size().height; ++scan_.y, scan_.x = 0) {
        const std::uint8_t* row = filled_.row(scan_.y);
        for (; scan_.x < size().width; ++scan_.x) {
            if (!row[scan_.x]) return scan_;
        }
    }
    return std::nullopt;
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
