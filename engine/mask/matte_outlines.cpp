#include "engine/mask/matte_outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace weft {
namespace {

constexpr float kHalfCoverage = 127.5f;
constexpr int kRing = 2;  // samples beyond the border: the border's own, then none

// Samples at the centres of pixels, with rings around them.
class CoverageGrid {
  public:
    explicit CoverageGrid(ViewU8x1 matte) : matte_(matte) {}

    [[nodiscard]] int columns() const { return matte_.width() + 2 * kRing; }
    [[nodiscard]] int rows() const { return matte_.height() + 2 * kRing; }
    [[nodiscard]] float at(int i, int j) const {
        if (i < 1 || j < 1 || i >= columns() - 1 || j >= rows() - 1) return 0;
        const int x = std::clamp(i - kRing, 0, matte_.width() - 1);
        const int y = std::clamp(j - kRing, 0, matte_.height() - 1);
        return static_cast<float>(matte_.row(y)[x]);
    }
    // Sides of cells: from sample (i, j) to the right, or down.
    [[nodiscard]] std::int64_t side(int i, int j, bool down) const {
        return 2 * (static_cast<std::int64_t>(j) * columns() + i) + (down ? 1 : 0);
    }
    // Where the line crosses a side, in pixels of the plate.
    [[nodiscard]] Vec2 crossing(std::int64_t side) const {
        const bool down = side % 2 == 1;
        const auto sample = side / 2;
        const int i = static_cast<int>(sample % columns()),
                  j = static_cast<int>(sample / columns());
        const float a = at(i, j), b = down ? at(i, j + 1) : at(i + 1, j);
        const float t = (kHalfCoverage - a) / (b - a);
        return Vec2(static_cast<float>(i) + (down ? 0.0f : t),
                    static_cast<float>(j) + (down ? t : 0.0f)) +
               Vec2(0.5f - kRing);
    }

  private:
    ViewU8x1 matte_;
};

// From each crossed side the one that the line goes to next, the inside on its right.
struct CrossedSides {
    std::vector<std::int64_t> order;
    std::unordered_map<std::int64_t, std::int64_t> next;
    void add(std::int64_t from, std::int64_t to) {
        order.push_back(from);
        next.emplace(from, to);
    }
};

void add_cell(const CoverageGrid& grid, int i, int j, CrossedSides& out) {
    const std::array<float, 4> corners{grid.at(i, j), grid.at(i + 1, j), grid.at(i + 1, j + 1),
                                       grid.at(i, j + 1)};
    std::array<bool, 4> in{};
    for (std::size_t k = 0; k < 4; ++k)
        in[k] = corners[k] > kHalfCoverage;
    if (in[0] == in[1] && in[1] == in[2] && in[2] == in[3]) return;
    // Clockwise from the top; side k joins corners k and k + 1.
    const std::array<std::int64_t, 4> sides{grid.side(i, j, false), grid.side(i + 1, j, true),
                                            grid.side(i, j + 1, false), grid.side(i, j, true)};
    // Clockwise round the cell, an inside that begins at side k ends at the next crossed side. The
    // line comes in where it ends. On a saddle the middle says which corners belong together.
    const bool saddle = in[0] == in[2] && in[1] == in[3];
    const bool joined =
        saddle && corners[0] + corners[1] + corners[2] + corners[3] > 4 * kHalfCoverage;
    for (std::size_t k = 0; k < 4; ++k) {
        if (in[k] || !in[(k + 1) % 4]) continue;
        std::size_t end = (k + 1) % 4;
        while (in[(end + 1) % 4])
            end = (end + 1) % 4;
        if (joined) end = (k + 3) % 4;  // the inside ends before the outside corner of this side
        out.add(sides[end], sides[k]);
    }
}

double area_inside(const std::vector<Vec2>& points) {
    double twice = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const glm::dvec2 a(points[k]), b(points[(k + 1) % points.size()]);
        twice += a.x * b.y - b.x * a.y;
    }
    return std::abs(twice) / 2;
}

bool is_inside(Vec2 p, const std::vector<Vec2>& points) {
    bool inside = false;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec2 a = points[k], b = points[(k + 1) % points.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

}  // namespace

std::vector<MatteOutline> outlines_of_matte(ViewU8x1 matte, double least_area_px) {
    std::vector<MatteOutline> out;
    if (matte.width() < 1 || matte.height() < 1) return out;
    const CoverageGrid grid(matte);
    CrossedSides sides;
    for (int j = 0; j + 1 < grid.rows(); ++j)
        for (int i = 0; i + 1 < grid.columns(); ++i)
            add_cell(grid, i, j, sides);
    for (const std::int64_t start : sides.order) {
        std::vector<Vec2> points;
        for (auto at = sides.next.find(start); at != sides.next.end();) {
            points.push_back(grid.crossing(at->first));
            const std::int64_t next = at->second;
            sides.next.erase(at);
            at = sides.next.find(next);
        }
        if (points.size() < 3) continue;
        const double area = area_inside(points);
        if (area < least_area_px || !(area > 0)) continue;
        out.push_back({OutlinePath(std::move(points)), 0, area});
    }
    for (MatteOutline& inner : out)
        for (const MatteOutline& outer : out)
            if (outer.area_px > inner.area_px &&
                is_inside(inner.path.points().front(), outer.path.points()))
                ++inner.level;
    return out;
}

}  // namespace weft
