#include "engine/synthesis/contact.h"

namespace weft {
namespace {

// One pair of opposite sides. Positions along the sides are lines; `edge` is where a side lies.
class Sides {
  public:
    // `filled(line, at)` for at ∈ [−1, depth].
    template <class Filled>
    Sides(int lines, int depth, int least, Filled filled)
        : stride_(static_cast<std::size_t>(lines) + 1),
          first_(stride_ * (static_cast<std::size_t>(depth) + 1), 0),
          last_(first_) {
        for (int line = 0; line < lines; ++line) {
            const auto next = static_cast<std::size_t>(line) + 1;
            // How many filled pixels follow each position, and how many come before it.
            int after = filled(line, depth) ? least : 0;
            for (int at = depth - 1; at >= 0; --at) {
                after = filled(line, at) ? after + 1 : 0;
                first_[static_cast<std::size_t>(at) * stride_ + next] =
                    filled(line, at - 1) && after < least;
            }
            int before = filled(line, -1) ? least : 0;
            for (int edge = 0; edge <= depth; ++edge) {
                last_[static_cast<std::size_t>(edge) * stride_ + next] =
                    filled(line, edge) && before < least;
                before = filled(line, edge) ? before + 1 : 0;
            }
        }
        for (auto* sums : {&first_, &last_}) {
            for (std::size_t i = 0; i < sums->size(); ++i) {
                if (i % stride_ != 0) (*sums)[i] += (*sums)[i - 1];
            }
        }
    }

    // Thin contacts of a span of lines, for the side before `begin` and the side at `end`.
    [[nodiscard]] std::uint32_t count(int begin, int end, int line0, int line1) const {
        const auto span = [&](const std::vector<std::uint32_t>& sums, int edge) {
            const std::size_t base = static_cast<std::size_t>(edge) * stride_;
            return sums[base + static_cast<std::size_t>(line1)] -
                   sums[base + static_cast<std::size_t>(line0)];
        };
        return span(first_, begin) + span(last_, end);
    }

  private:
    std::size_t stride_;
    std::vector<std::uint32_t> first_, last_;  ///< Per edge, sums over the lines before.
};

}  // namespace

std::vector<std::uint32_t> thin_contacts(const Canvas& canvas, const Block& block, Size window,
                                         Vec2i lo, Vec2i hi, Vec2i least_px) {
    const int w = block.rect.width(), h = block.rect.height();
    Image<std::uint8_t, 1> filled(w + 2, h + 2, 0);
    for (int y = -1; y <= h; ++y) {
        for (int x = -1; x <= w; ++x) {
            const bool border = x < 0 || y < 0 || x == w || y == h;
            filled.at(x + 1, y + 1) = border ? canvas.filled(block.rect.x0 + x, block.rect.y0 + y)
                                             : block.filled.at(x, y) != 0;
        }
    }
    const Sides rows(h, w, least_px.x, [&](int y, int x) { return filled.at(x + 1, y + 1) != 0; });
    const Sides columns(w, h, least_px.y,
                        [&](int x, int y) { return filled.at(x + 1, y + 1) != 0; });
    std::vector<std::uint32_t> counts;
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
