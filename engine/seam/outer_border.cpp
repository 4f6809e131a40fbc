#include "engine/seam/outer_border.h"

#include <algorithm>
#include <array>

#include "engine/core/geometry.h"

namespace weft {
namespace {

constexpr std::array<Vec2i, 4> kForward{Vec2i{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
constexpr std::array<Vec2i, 4> kOutward{Vec2i{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
constexpr std::array<Vec2i, 4> kEndCorner{Vec2i{1, 0}, {1, 1}, {0, 1}, {0, 0}};

// A side of a pixel that faces the outside, found on the walk, and the corner where it ends.
struct BorderSide {
    SeamCell tie;
    std::int32_t corner;
};

class OuterBorder {
  public:
    explicit OuterBorder(const Image<SeamCell, 1>& cells)
        : w_(cells.width()), h_(cells.height()), padded_(w_ + 2, h_ + 2, SeamCell::kOutside) {
        for (int y = 0; y < h_; ++y)
            std::copy_n(cells.row(y), w_, padded_.row(y + 1) + 1);
    }

    std::optional<BorderStretches> find() {
        if (!walk() || !group() || !ties_reach_border()) return std::nullopt;
        return std::move(out_);
    }

  private:
    [[nodiscard]] SeamCell cell(int x, int y) const { return padded_.row(y + 1)[x + 1]; }
    [[nodiscard]] bool takes_part(int x, int y) const { return cell(x, y) != SeamCell::kOutside; }
    [[nodiscard]] std::int32_t corner_index(int x, int y) const {
        return (y + 1) * (w_ + 2) + x + 1;
    }

    // Sides between a pixel of the overlap and one outside.
    [[nodiscard]] std::size_t count_sides() const {
        std::size_t sides = 0;
        for (int y = 0; y <= h_; ++y) {
            const SeamCell *row = padded_.row(y), *below = padded_.row(y + 1);
            int in_row = 0;
            for (int x = 0; x <= w_; ++x) {
                const bool here = row[x] != SeamCell::kOutside;
                in_row += (here != (row[x + 1] != SeamCell::kOutside)) +
                          (here != (below[x] != SeamCell::kOutside));
            }
            sides += static_cast<std::size_t>(in_row);
        }
        return sides;
    }

    // Follows the outer border of the first component. False unless that is the whole border, so
    // that there is one component without holes.
    bool walk() {
        int x = 0, y = 0;
        const SeamCell* first =
            std::find_if(padded_.data(), padded_.data() + padded_.size_bytes() / sizeof(SeamCell),
                         [](SeamCell c) { return c != SeamCell::kOutside; });
        const std::ptrdiff_t at = first - padded_.data();
        if (at >= std::ptrdiff_t{w_ + 2} * (h_ + 2)) return false;
        const int start_x = static_cast<int>(at % (w_ + 2)) - 1;
        const int start_y = static_cast<int>(at / (w_ + 2)) - 1;
        const std::size_t sides = count_sides();
        border_.reserve(sides);
        std::size_t side = 0;
        x = start_x, y = start_y;
        do {
            const Vec2i f = kForward[side], n = kOutward[side], e = kEndCorner[side];
            border_.push_back({cell(x, y), corner_index(x + e.x, y + e.y)});
            if (!takes_part(x + f.x, y + f.y)) {
                side = (side + 1) % 4;
            } else {
                x += f.x, y += f.y;
                if (takes_part(x + n.x, y + n.y)) {
                    x += n.x, y += n.y;
                    side = (side + 3) % 4;
                }
            }
        } while (x != start_x || y != start_y || side != 0);
        return border_.size() == sides;
    }

    // Groups the corners of each free stretch of border. False unless the ties form one old and one
    // new arc. A corner that the walk passes twice lies between two pixels that touch only
    // diagonally: no arc meets it, and it must not join the two stretches that it belongs to.
    bool group() {
        const std::size_t n = border_.size();
        std::size_t first = 0;
        while (first < n && border_[first].tie == SeamCell::kFree)
            ++first;
        if (first == n) return false;
        std::vector<std::uint8_t> passes(
            static_cast<std::size_t>(w_ + 2) * static_cast<std::size_t>(h_ + 2), 0);
        for (const BorderSide& s : border_)
            ++passes[static_cast<std::size_t>(s.corner)];
        int changes = 0;
        for (std::size_t k = 0; k < n;) {
            const SeamCell from = border_[(first + k) % n].tie;
            CornerGroup corners;
            do {
                const std::int32_t corner = border_[(first + k) % n].corner;
                if (passes[static_cast<std::size_t>(corner)] == 1) corners.push_back(corner);
                ++k;
            } while (border_[(first + k) % n].tie == SeamCell::kFree);
            const SeamCell to = border_[(first + k) % n].tie;
            if (from == to) {
                if (corners.size() > 1) out_.others.push_back(std::move(corners));
                continue;
            }
            ++changes;
            (from == SeamCell::kOld ? out_.start : out_.end) = std::move(corners);
        }
        return changes == 2;
    }

    [[nodiscard]] bool on_border(int x, int y) const {
        return std::any_of(kOutward.begin(), kOutward.end(),
                           [&](Vec2i n) { return !takes_part(x + n.x, y + n.y); });
    }

    // Tied pixels away from the border must be connected to a tied border pixel of their kind;
    // otherwise their terminal is not on the outer face.
    [[nodiscard]] bool ties_reach_border() const {
        std::vector<Vec2i> inner;
        for (int y = 0; y < h_; ++y) {
            const SeamCell* row = padded_.row(y + 1) + 1;
            for (int x = 0; x < w_; ++x) {
                if ((row[x] == SeamCell::kOld || row[x] == SeamCell::kNew) && !on_border(x, y)) {
                    inner.push_back({x, y});
                }
            }
        }
        if (inner.empty()) return true;
        Image<std::uint8_t, 1> seen(w_, h_, 0);
        std::vector<Vec2i> stack;
        for (int y = 0; y < h_; ++y) {
            for (int x = 0; x < w_; ++x) {
                const SeamCell c = cell(x, y);
                if ((c != SeamCell::kOld && c != SeamCell::kNew) || !on_border(x, y)) continue;
                seen.at(x, y) = 1;
                stack.push_back({x, y});
            }
        }
        while (!stack.empty()) {
            const Vec2i c = stack.back();
            stack.pop_back();
            for (const Vec2i n : kOutward) {
                const int x = c.x + n.x, y = c.y + n.y;
                if (!takes_part(x, y) || cell(x, y) != cell(c.x, c.y) || seen.at(x, y)) continue;
                seen.at(x, y) = 1;
                stack.push_back({x, y});
            }
        }
        return std::all_of(inner.begin(), inner.end(),
                           [&](Vec2i c) { return seen.at(c.x, c.y) != 0; });
    }

    const int w_, h_;
    Image<SeamCell, 1> padded_;
    std::vector<BorderSide> border_;
    BorderStretches out_;
};

}  // namespace

std::optional<BorderStretches> border_stretches(const Image<SeamCell, 1>& cells) {
    return OuterBorder(cells).find();
}

}  // namespace weft
