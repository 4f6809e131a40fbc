#include "engine/synthesis/canvas.h"

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
        for (int x = 0; x < rect.width(); ++x) {
            const auto p = canvas.resolve(rect.x0 + x, rect.y0 + y);
            if (!p) continue;
            block.inside.at(x, y) = 1;
            block.filled.at(x, y) = canvas.filled(p->x, p->y) ? 1 : 0;
            const std::uint8_t* from = canvas.pixels().pixel(p->x, p->y);
            std::uint8_t* to = block.pixels.pixel(x, y);
            to[0] = from[0], to[1] = from[1], to[2] = from[2];
        }
    }
    return block;
}

}  // namespace weft
