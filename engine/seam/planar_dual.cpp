// A minimum cut whose terminals both lie on the outer face of a planar graph is a shortest path in
// the dual (Ford & Fulkerson 1956, Hassin 1981). The pixels of the overlap are the graph; its faces
// are the corners between four pixels. All corners on the overlap's outer border are one face,
// which the ties split: source and sink sit outside and reach their border pixels by arcs of
// infinite capacity, so that every stretch of free border between two ties is a face of its own.
// The two stretches between the old and the new arc are the path's free ends.

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/seam/bit_flood.h"
#include "engine/seam/corner_grid.h"
#include "engine/seam/outer_border.h"
#include "engine/seam/seam.h"

namespace weft {
namespace {

// Two pixels tied to the same side are never separated.
bool can_part(SeamCell a, SeamCell b) {
    return a != SeamCell::kOutside && b != SeamCell::kOutside && (a == SeamCell::kFree || a != b);
}

// The cost of a step from each corner to the right (between a vertical pair of pixels) and down
// (between a horizontal pair).
CornerGrid dual_of(const SeamProblem& p) {
    const int w = p.cells.width(), h = p.cells.height();
    CornerGrid grid(p.cells.size());
    for (int y = 0; y < h; ++y) {
        const SeamCell* row = p.cells.row(y);
        const std::int32_t* right = p.right.row(y);
        std::uint32_t* down = &grid.down[static_cast<std::size_t>(grid.index(1, y))];
        for (int x = 0; x + 1 < w; ++x) {
            if (can_part(row[x], row[x + 1])) down[x] = static_cast<std::uint32_t>(right[x]);
        }
        if (y + 1 == h) continue;
        const SeamCell* below = p.cells.row(y + 1);
        const std::int32_t* step = p.down.row(y);
        std::uint32_t* across = &grid.right[static_cast<std::size_t>(grid.index(0, y + 1))];
        for (int x = 0; x < w; ++x) {
            if (can_part(row[x], below[x])) across[x] = static_cast<std::uint32_t>(step[x]);
        }
    }
    return grid;
}

// The distances, capped at the cut's value, are flow potentials. Their differences are a maximum
// flow from old to new: to the right φ(below) − φ(above), downwards φ(left) − φ(right). The pixels
// that the old ties reach in its residual graph are the minimal source set.
Image<std::uint8_t, 1> minimal_source_set(const SeamProblem& p, const CornerGrid& grid,
                                          const std::vector<std::uint64_t>& distance) {
    const int w = p.cells.width(), h = p.cells.height();
    FloodSteps steps(p.cells.size());
    BitRows reached(p.cells.size());
    const auto set = [](std::uint64_t* row, int x, bool value) {
        row[static_cast<std::size_t>(x) / 64] |= std::uint64_t{value} << (x % 64);
    };
    for (int y = 0; y < h; ++y) {
        const SeamCell *row = p.cells.row(y), *below = y + 1 < h ? p.cells.row(y + 1) : nullptr;
        const std::uint64_t* above_phi = &distance[static_cast<std::size_t>(grid.index(0, y))];
        const std::uint64_t* below_phi = &distance[static_cast<std::size_t>(grid.index(0, y + 1))];
        for (int x = 0; x < w; ++x) {
            if (row[x] == SeamCell::kOutside) continue;
            set(reached.row(y), x, row[x] == SeamCell::kOld);
            if (x + 1 < w && row[x + 1] != SeamCell::kOutside) {
                const auto flow = static_cast<std::int64_t>(below_phi[x + 1] - above_phi[x + 1]);
                const std::int64_t capacity = p.right.row(y)[x];
                set(steps.right.row(y), x, flow < capacity);
                set(steps.left.row(y), x + 1, -flow < capacity);
            }
            if (below && below[x] != SeamCell::kOutside) {
                const auto flow = static_cast<std::int64_t>(below_phi[x] - below_phi[x + 1]);
                const std::int64_t capacity = p.down.row(y)[x];
                set(steps.down.row(y), x, flow < capacity);
                set(steps.up.row(y + 1), x, -flow < capacity);
            }
        }
    }
    flood(steps, reached);
    Image<std::uint8_t, 1> labels(w, h, 0);
    for (int y = 0; y < h; ++y) {
        const SeamCell* row = p.cells.row(y);
        for (int x = 0; x < w; ++x) {
            const bool old = (reached.row(y)[static_cast<std::size_t>(x) / 64] >> (x % 64)) & 1;
            labels.row(y)[x] = row[x] != SeamCell::kOutside && !old ? 1 : 0;
        }
    }
    return labels;
}

}  // namespace

std::optional<SeamResult> solve_planar_dual(const SeamProblem& problem) {
    if (!problem.old_cost.empty()) return std::nullopt;
    const auto border = border_stretches(problem.cells);
    if (!border) return std::nullopt;
    const CornerGrid grid = dual_of(problem);
    const CornerDistances distances =
        corner_distances(grid, border->start, border->end, border->others);
    SeamResult result;
    result.energy = static_cast<std::int64_t>(distances.to_end);
    result.labels = minimal_source_set(problem, grid, distances.distance);
    // Costs, distances in both formats, four bits of steps and one bit of reached per pixel.
    result.graph_bytes = grid.right.size() * (3 * sizeof(std::uint32_t) + sizeof(std::uint64_t)) +
                         problem.cells.size_bytes() * 5 / 8;
    return result;
}

}  // namespace weft
