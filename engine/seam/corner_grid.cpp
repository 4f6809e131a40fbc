#include "engine/seam/corner_grid.h"

#include <algorithm>

#include "engine/seam/radix_heap.h"

namespace weft {

CornerGrid::CornerGrid(Size pixels)
    : width(pixels.width + 1), height(pixels.height + 1), stride(pixels.width + 2) {
    const std::size_t n = static_cast<std::size_t>(stride) * static_cast<std::size_t>(height + 2);
    right.assign(n, kWall);
    down.assign(n, kWall);
}

CornerDistances corner_distances(const CornerGrid& grid, const CornerGroup& start,
                                 const CornerGroup& end, const std::vector<CornerGroup>& groups) {
    CornerDistances out = distances_by_passes(grid, start, end, groups);
    return out.distance.empty() ? distances_by_heap(grid, start, end, groups) : out;
}

CornerDistances distances_by_heap(const CornerGrid& grid, const CornerGroup& start,
                                  const CornerGroup& end, const std::vector<CornerGroup>& groups) {
    CornerDistances out;
    out.distance.assign(grid.right.size(), CornerDistances::kUnreachable);
    std::vector<std::int32_t> group_of(grid.right.size(), -1);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        for (const std::int32_t c : groups[g])
            group_of[static_cast<std::size_t>(c)] = static_cast<std::int32_t>(g);
    }
    std::vector<std::uint8_t> is_end(grid.right.size(), 0);
    for (const std::int32_t c : end)
        is_end[static_cast<std::size_t>(c)] = 1;

    RadixHeap heap;
    const auto relax = [&](std::int32_t corner, std::uint64_t d) {
        std::uint64_t& best = out.distance[static_cast<std::size_t>(corner)];
        if (d < best) best = d, heap.push(d, corner);
    };
    for (const std::int32_t c : start)
        relax(c, 0);
    while (!heap.empty()) {
        const auto [d, corner] = heap.pop();
        const auto i = static_cast<std::size_t>(corner);
        if (d != out.distance[i]) continue;
        if (is_end[i]) {
            out.to_end = d;
            break;
        }
        if (group_of[i] >= 0) {
            for (const std::int32_t c : groups[static_cast<std::size_t>(group_of[i])])
                relax(c, d);
        }
        const auto step = [&, here = d](std::uint32_t cost, std::int32_t to) {
            if (cost != CornerGrid::kWall) relax(to, here + cost);
        };
        step(grid.right[i], corner + 1);
        step(grid.right[i - 1], corner - 1);
        step(grid.down[i], corner + grid.stride);
        step(grid.down[i - static_cast<std::size_t>(grid.stride)], corner - grid.stride);
    }
    for (std::uint64_t& d : out.distance)
        d = std::min(d, out.to_end);
    return out;
}

}  // namespace weft
