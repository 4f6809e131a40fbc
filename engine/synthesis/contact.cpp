#include "engine/synthesis/contact.h"

namespace weft {
namespace {

// One pair of opposite sides. Positions along the sides are lines; a side lies at an edge, between
// the positions edge − 1 and edge across the lines.
class Sides {
  public:
    // `filled(line, at)` for at ∈ [−1, depth].
    template <class Filled>
    Sides(int lines, int depth, int least, Filled filled)
        : stride_(static_cast<std::size_t>(depth) + 1),
          first_(stride_ * (static_cast<std::size_t>(lines) + 1), 0),
          last_(first_) {
        for (int line = 0; line < lines; ++line) {
            const std::size_t above = static_cast<std::size_t>(line) * stride_;
            std::uint16_t* first = &first_[above + stride_];
            std::uint16_t* last = &last_[above + stride_];
            // How many filled pixels follow each edge, and how many precede it.
            int after = filled(line, depth) ? least : 0;
            for (int at = depth - 1; at >= 0; --at) {
                after = filled(line, at) ? after + 1 : 0;
                first[at] = filled(line, at - 1) && after < least;
            }
            int before = filled(line, -1) ? least : 0;
            for (int edge = 0; edge <= depth; ++edge) {
                last[edge] = filled(line, edge) && before < least;
                before = filled(line, edge) ? before + 1 : 0;
            }
            for (std::size_t i = 0; i < stride_; ++i) {
                first[i] = static_cast<std::uint16_t>(first[i] + first_[above + i]);
                last[i] = static_cast<std::uint16_t>(last[i] + last_[above + i]);
            }
        }
    }

    // Thin contacts of the lines [line0, line1) with the sides at two edges.
    [[nodiscard]] std::uint32_t count(int begin, int end, int line0, int line1) const {
        const auto at = [&](const std::vector<std::uint16_t>& sums, int line, int edge) {
            return std::uint32_t{
                sums[static_cast<std::size_t>(line) * stride_ + static_cast<std::size_t>(edge)]};
        };
        return at(first_, line1, begin) - at(first_, line0, begin) + at(last_, line1, end) -
               at(last_, line0, end);
    }

  private:
    std::size_t stride_;
    std::vector<std::uint16_t> first_, last_;  ///< Per edge, sums over the lines before.
};

}  // namespace

std::vector<std::uint32_t> thin_contacts(const Canvas& canvas, const Block& block, Size window,
                                         Vec2i lo, Vec2i hi, Vec2i least_px) {
    const int w = block.rect.width(), h = block.rect.height();
    Image<std::uint8_t, 1> filled(w + 2, h + 2, 0);
    for (int y = -1; y <= h; ++y) {
        std::uint8_t* row = filled.pixel(1, y + 1);
        const bool border = y < 0 || y == h;
        for (int x = -1; x <= w; ++x) {
            row[x] = border || x < 0 || x == w ? canvas.filled(block.rect.x0 + x, block.rect.y0 + y)
                                               : block.filled.row(y)[x];
        }
    }
    const std::uint8_t* origin = filled.pixel(1, 1);
    const std::ptrdiff_t stride = filled.stride();
    const Sides rows(h, w, least_px.x, [=](int y, int x) { return origin[y * stride + x] != 0; });
    const Sides columns(w, h, least_px.y,
                        [=](int x, int y) { return origin[y * stride + x] != 0; });
    std::vector<std::uint32_t> counts;
    counts.reserve(static_cast<std::size_t>(hi.x - lo.x + 1) *
                   static_cast<std::size_t>(hi.y - lo.y + 1));
    for (int ty = lo.y; ty <= hi.y; ++ty) {
        for (int tx = lo.x; tx <= hi.x; ++tx) {
            const Recti r = rect_of(block.rect.size())
                                .intersected({tx, ty, tx + window.width, ty + window.height});
            counts.push_back(r.empty() ? 0
                                       : rows.count(r.x0, r.x1, r.y0, r.y1) +
                                             columns.count(r.y0, r.y1, r.x0, r.x1));
        }
    }
    return counts;
}

}  // namespace weft
