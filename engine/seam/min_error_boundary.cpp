// Efros & Freeman 2001 with the costs of the exact cut: one boundary for each side of the window
// that is tied to the old picture, each the cheapest one that is monotone along its side.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/seam/seam.h"

namespace weft {
namespace {

constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max() / 4;

// The window seen from one side: line l runs along the side, depth d away from it.
struct SideView {
    const SeamProblem& p;
    int side;  ///< 0 left, 1 top, 2 right, 3 bottom.

    [[nodiscard]] int lines() const { return side % 2 == 0 ? p.cells.height() : p.cells.width(); }
    [[nodiscard]] int depth() const { return side % 2 == 0 ? p.cells.width() : p.cells.height(); }
    [[nodiscard]] Vec2i pixel(int l, int d) const {
        switch (side) {
            case 0:
                return {d, l};
            case 1:
                return {l, d};
            case 2:
                return {p.cells.width() - 1 - d, l};
            default:
                return {l, p.cells.height() - 1 - d};
        }
    }
    [[nodiscard]] SeamCell cell(int l, int d) const {
        const Vec2i c = pixel(l, d);
        return p.cells.at(c.x, c.y);
    }
    // The arc between two neighbouring pixels; 0 if one of them is outside the overlap.
    [[nodiscard]] std::int64_t arc(Vec2i a, Vec2i b) const {
        if (p.cells.at(a.x, a.y) == SeamCell::kOutside ||
            p.cells.at(b.x, b.y) == SeamCell::kOutside) {
            return 0;
        }
        return a.y == b.y ? p.right.at(std::min(a.x, b.x), a.y)
                          : p.down.at(a.x, std::min(a.y, b.y));
    }
    [[nodiscard]] std::int64_t across(int l, int d) const {  ///< Between depth d−1 and d.
        return arc(pixel(l, d - 1), pixel(l, d));
    }
    [[nodiscard]] std::int64_t along(int l, int d) const {  ///< Between lines l−1 and l.
        return arc(pixel(l - 1, d), pixel(l, d));
    }
    // The most pixels from the side that may stay old.
    [[nodiscard]] int reach(int l) const {
        int d = 0;
        while (d < depth() && (cell(l, d) == SeamCell::kFree || cell(l, d) == SeamCell::kOld))
            ++d;
        return d;
    }
};

// For lines [l0, l1): at[l] pixels from the side stay old, between 1 and reach[l].
void cut_lines(const SideView& v, int l0, int l1, const std::vector<int>& reach,
               std::vector<int>& at) {
    const auto span = static_cast<std::size_t>(v.depth()) + 1;
    std::vector<std::int64_t> best(span, kFar), next(span);
    std::vector<std::vector<int>> from(static_cast<std::size_t>(l1 - l0), std::vector<int>(span));
    const auto line_cost = [&v](int l, int d) { return d < v.depth() ? v.across(l, d) : 0; };
    for (int d = 1; d <= reach[static_cast<std::size_t>(l0)]; ++d) {
        best[static_cast<std::size_t>(d)] = line_cost(l0, d);
    }
    for (int l = l0 + 1; l < l1; ++l) {
        auto& origin = from[static_cast<std::size_t>(l - l0)];
        for (std::size_t d = 0; d < span; ++d)
            next[d] = best[d], origin[d] = static_cast<int>(d);
        for (std::size_t d = 1; d < span; ++d) {
            const std::int64_t slide = next[d - 1] + v.along(l, static_cast<int>(d) - 1);
            if (slide < next[d]) next[d] = slide, origin[d] = origin[d - 1];
        }
        for (std::size_t d = span - 1; d-- > 0;) {
            const std::int64_t slide = next[d + 1] + v.along(l, static_cast<int>(d));
            if (slide < next[d]) next[d] = slide, origin[d] = origin[d + 1];
        }
        for (int d = 0; d < static_cast<int>(span); ++d) {
            const auto i = static_cast<std::size_t>(d);
            const bool allowed = d >= 1 && d <= reach[static_cast<std::size_t>(l)];
            best[i] = allowed ? next[i] + line_cost(l, d) : kFar;
        }
    }
    auto d = static_cast<int>(std::min_element(best.begin(), best.end()) - best.begin());
    for (int l = l1 - 1; l >= l0; --l) {
        at[static_cast<std::size_t>(l)] = d;
        d = from[static_cast<std::size_t>(l - l0)][static_cast<std::size_t>(d)];
    }
}

// Marks the pixels before the boundary along one side as old.
void cut_side(const SideView& v, Image<std::uint8_t, 1>& labels) {
    const int lines = v.lines();
    std::vector<int> reach(static_cast<std::size_t>(lines)), at(static_cast<std::size_t>(lines), 0);
    // If a side's overlap never ends inside the window, another side limits it.
    int narrowest = v.depth();
    for (int l = 0; l < lines; ++l) {
        reach[static_cast<std::size_t>(l)] = v.reach(l);
        if (v.reach(l) > 0) narrowest = std::min(narrowest, v.reach(l));
    }
    for (int& r : reach) {
        if (r == v.depth()) r = std::min(r, narrowest);
    }
    const auto tied = [&](int l) {
        return reach[static_cast<std::size_t>(l)] > 0 && v.cell(l, 0) == SeamCell::kOld;
    };
    for (int l = 0; l < lines;) {
        if (!tied(l)) {
            ++l;
            continue;
        }
        const int first = l;
        while (l < lines && tied(l))
            ++l;
        cut_lines(v, first, l, reach, at);
    }
    for (int l = 0; l < lines; ++l) {
        for (int d = 0; d < at[static_cast<std::size_t>(l)]; ++d) {
            const Vec2i c = v.pixel(l, d);
            labels.at(c.x, c.y) = 0;
        }
    }
}

}  // namespace

SeamResult solve_min_error_boundary(const SeamProblem& problem) {
    SeamResult result = solve_direct(problem);
    for (int side = 0; side < 4; ++side)
        cut_side(SideView{problem, side}, result.labels);
    for (int y = 0; y < problem.cells.height(); ++y) {
        for (int x = 0; x < problem.cells.width(); ++x) {
            if (problem.cells.at(x, y) == SeamCell::kNew) result.labels.at(x, y) = 1;
        }
    }
    result.energy = seam_energy(problem, result.labels);
    return result;
}

}  // namespace weft
