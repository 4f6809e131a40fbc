#pragma once
// Random seam problems of the shapes that synthesis meets, and independent solvers to compare with.

#include <cstdint>
#include <vector>

#include "engine/core/rng.h"
#include "engine/seam/seam.h"

namespace weft::test {

/// How arcs are drawn: mostly distinct, few different values (many ties), or mostly zeros.
enum class Costs { kDistinct, kTies, kZeros };

inline std::int32_t draw(Rng& rng, Costs costs) {
    switch (costs) {
        case Costs::kDistinct:
            return static_cast<std::int32_t>(rng.below(1'000'000));
        case Costs::kTies:
            return static_cast<std::int32_t>(1 + rng.below(3));
        default:
            return rng.below(3) ? 0 : static_cast<std::int32_t>(rng.below(4));
    }
}

inline SeamProblem empty_problem(int w, int h) {
    SeamProblem p;
    p.cells = Image<SeamCell, 1>(w, h, SeamCell::kOutside);
    p.right = Image<std::int32_t, 1>(w, h, 0);
    p.down = Image<std::int32_t, 1>(w, h, 0);
    return p;
}

inline void draw_arcs(SeamProblem& p, Rng& rng, Costs costs) {
    for (int y = 0; y < p.cells.height(); ++y) {
        for (int x = 0; x < p.cells.width(); ++x) {
            p.right.at(x, y) = draw(rng, costs);
            p.down.at(x, y) = draw(rng, costs);
        }
    }
}

inline void draw_data(SeamProblem& p, Rng& rng, Costs costs) {
    p.old_cost = p.new_cost = Image<std::int32_t, 1>(p.cells.size(), 0);
    for (int y = 0; y < p.cells.height(); ++y) {
        for (int x = 0; x < p.cells.width(); ++x) {
            p.old_cost.at(x, y) = draw(rng, costs);
            p.new_cost.at(x, y) = draw(rng, costs);
        }
    }
}

/// A strip: the left column is old, the right one new.
inline SeamProblem strip(int w, int h, Rng& rng, Costs costs) {
    SeamProblem p = empty_problem(w, h);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            p.cells.at(x, y) = x == 0       ? SeamCell::kOld
                               : x == w - 1 ? SeamCell::kNew
                                            : SeamCell::kFree;
        }
    }
    draw_arcs(p, rng, costs);
    return p;
}

/// An overlap given by a filled canvas and a window on it, tied as synthesis ties it: a pixel with
/// an old neighbour outside the window is old, otherwise one with an empty neighbour inside is new.
/// `filled` is one pixel larger than the window on every side.
inline SeamProblem overlap_of(const Image<std::uint8_t, 1>& filled, Rng& rng, Costs costs) {
    const int w = filled.width() - 2, h = filled.height() - 2;
    SeamProblem p = empty_problem(w, h);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            if (!filled.at(x + 1, y + 1)) continue;
            bool old_outside = false, empty_inside = false;
            for (const Vec2i d : {Vec2i{1, 0}, Vec2i{-1, 0}, Vec2i{0, 1}, Vec2i{0, -1}}) {
                const int nx = x + d.x, ny = y + d.y;
                const bool inside = nx >= 0 && ny >= 0 && nx < w && ny < h;
                const bool is_filled = filled.at(nx + 1, ny + 1) != 0;
                old_outside |= !inside && is_filled;
                empty_inside |= inside && !is_filled;
            }
            p.cells.at(x, y) = old_outside    ? SeamCell::kOld
                               : empty_inside ? SeamCell::kNew
                                              : SeamCell::kFree;
        }
    }
    draw_arcs(p, rng, costs);
    return p;
}

/// A window whose first `left` columns and `top` rows (with a ragged lower edge) are filled.
inline SeamProblem l_shape(int w, int h, int left, int top, int ragged, Rng& rng, Costs costs) {
    Image<std::uint8_t, 1> filled(w + 2, h + 2, 0);
    for (int x = 0; x < w + 2; ++x) {
        const int depth = top + static_cast<int>(rng.below(static_cast<std::uint64_t>(ragged) + 1));
        for (int y = 0; y < h + 2; ++y)
            filled.at(x, y) = x < left + 1 || y < depth + 1 ? 1 : 0;
    }
    return overlap_of(filled, rng, costs);
}

/// A window filled but for a rectangle in its middle.
inline SeamProblem annulus(int w, int h, int width, Rng& rng, Costs costs) {
    Image<std::uint8_t, 1> filled(w + 2, h + 2, 1);
    for (int y = width + 1; y < h + 1 - width; ++y) {
        for (int x = width + 1; x < w + 1 - width; ++x)
            filled.at(x, y) = 0;
    }
    return overlap_of(filled, rng, costs);
}

/// Any shape and any ties: every pixel is drawn by itself.
inline SeamProblem soup(int w, int h, Rng& rng, Costs costs) {
    SeamProblem p = empty_problem(w, h);
    for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
            const std::uint64_t r = rng.below(16);
            p.cells.at(x, y) = r < 3   ? SeamCell::kOutside
                               : r < 5 ? SeamCell::kOld
                               : r < 7 ? SeamCell::kNew
                                       : SeamCell::kFree;
        }
    }
    draw_arcs(p, rng, costs);
    return p;
}

/// A 4-connected blob grown pixel by pixel, its border tied old on one arc and new on another.
inline SeamProblem blob(int w, int h, int pixels, Rng& rng, Costs costs) {
    SeamProblem p = empty_problem(w, h);
    std::vector<Vec2i> members{{w / 2, h / 2}};
    p.cells.at(w / 2, h / 2) = SeamCell::kFree;
    while (static_cast<int>(members.size()) < pixels) {
        const Vec2i from = members[rng.below(members.size())];
        constexpr Vec2i kSteps[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
        const Vec2i to = from + kSteps[rng.below(4)];
        if (to.x < 0 || to.y < 0 || to.x >= w || to.y >= h) continue;
        if (p.cells.at(to.x, to.y) != SeamCell::kOutside) continue;
        p.cells.at(to.x, to.y) = SeamCell::kFree;
        members.push_back(to);
    }
    for (const Vec2i m : members) {
        if (rng.below(4) == 0) {
            p.cells.at(m.x, m.y) = m.x + m.y < (w + h) / 2 ? SeamCell::kOld : SeamCell::kNew;
        }
    }
    draw_arcs(p, rng, costs);
    return p;
}

}  // namespace weft::test
