#pragma once
// Shortest distances over the corners between pixels: the planar dual of an overlap.

#include <cstdint>
#include <vector>

#include "engine/core/geometry.h"

namespace weft {

/// (width + 1) × (height + 1) corners of width × height pixels with the costs of stepping between
/// neighbours. Padding, one row above and below and one column at the left, gives every corner four
/// neighbours in the arrays.
struct CornerGrid {
    static constexpr std::uint32_t kWall = std::uint32_t{1} << 31;

    explicit CornerGrid(Size pixels);
    [[nodiscard]] std::int32_t index(int x, int y) const { return (y + 1) * stride + x + 1; }

    int width, height;  ///< In corners.
    std::int32_t stride;
    std::vector<std::uint32_t> right, down;  ///< Cost to the next corner, below 2^31, or kWall.
};

/// Corners that form one face: a step between them costs nothing.
using CornerGroup = std::vector<std::int32_t>;

/// Distances of all corners from `start`, in 64 bits; at most the distance to `end`, and 0 in the
/// padding. `to_end` is the distance to `end`, or kUnreachable.
struct CornerDistances {
    static constexpr std::uint64_t kUnreachable = ~std::uint64_t{0};
    std::vector<std::uint64_t> distance;
    std::uint64_t to_end = kUnreachable;
};
[[nodiscard]] CornerDistances corner_distances(const CornerGrid& grid, const CornerGroup& start,
                                               const CornerGroup& end,
                                               const std::vector<CornerGroup>& groups);

/// The two algorithms, for tests: Dijkstra's, and passes over rows and columns. The passes are
/// faster on photographs; they return an empty `distance` if a distance may not fit their 30 bits.
[[nodiscard]] CornerDistances distances_by_heap(const CornerGrid& grid, const CornerGroup& start,
                                                const CornerGroup& end,
                                                const std::vector<CornerGroup>& groups);
[[nodiscard]] CornerDistances distances_by_passes(const CornerGrid& grid, const CornerGroup& start,
                                                  const CornerGroup& end,
                                                  const std::vector<CornerGroup>& groups);

}  // namespace weft
