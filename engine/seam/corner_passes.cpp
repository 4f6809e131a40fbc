// Distances by passes over whole rows and columns, down, up, right and left, until no step improves
// any of them. A seam through photographs seldom turns back, so a few passes are enough. Each is a
// linear walk through memory; Dijkstra's heap costs more than all of them. The result is the same,
// because the distances are the only fixed point.

#include <algorithm>

#include "engine/seam/corner_grid.h"

namespace weft {
namespace {

constexpr std::uint32_t kFar = std::uint32_t{1} << 30;  // So that far plus a wall fits 32 bits.

// Lines are rows or columns. `along` and `across` are the array distances from a corner to the next
// one on its line and on the next line.
struct Lines {
    int count, length;
    std::ptrdiff_t along, across;
    const std::uint32_t *along_cost, *across_cost;
};

class Passes {
  public:
    explicit Passes(const CornerGrid& grid)
        : grid_(grid),
          rows_{grid.height, grid.width, 1, grid.stride, grid.right.data(), grid.down.data()},
          columns_{grid.width, grid.height, grid.stride, 1, grid.down.data(), grid.right.data()},
          distance_(grid.right.size(), kFar),
          row_hull_(static_cast<std::size_t>(grid.height)),
          column_hull_(static_cast<std::size_t>(grid.width)),
          column_works_(static_cast<std::size_t>(grid.width)) {
        find_hulls();
    }

    std::vector<std::uint32_t>& distance() { return distance_; }

    void run(const std::vector<CornerGroup>& groups) {
        // A cut of an L-shaped overlap starts at its upper right end and goes left, then down.
        for (int turn = 0;; ++turn) {
            for (const CornerGroup& g : groups)
                join(g);
            if (turn % 2 == 0) {
                if (!find_work_on_columns()) return;
                pass(columns_, column_hull_, column_works_, turn % 4 == 0);
            } else {
                const bool forward = turn % 4 == 1;
                std::vector<std::uint8_t> work(static_cast<std::size_t>(grid_.height), 0);
                if (find_work_on_rows(work)) pass(rows_, row_hull_, work, !forward);
            }
        }
    }

  private:
    struct Hull {
        int first = 0, last = -1;
        void join(int i) {
            if (last < first) first = i;
            last = std::max(last, i);
            first = std::min(first, i);
        }
    };

    [[nodiscard]] std::ptrdiff_t at(int x, int y) const { return grid_.index(x, y); }

    void find_hulls() {
        const auto touch = [&](int x, int y) {
            row_hull_[static_cast<std::size_t>(y)].join(x);
            column_hull_[static_cast<std::size_t>(x)].join(y);
        };
        for (int y = 0; y < grid_.height; ++y) {
            const std::uint32_t* right = &grid_.right[static_cast<std::size_t>(at(0, y))];
            const std::uint32_t* down = &grid_.down[static_cast<std::size_t>(at(0, y))];
            for (int x = 0; x < grid_.width; ++x) {
                if (right[x] != CornerGrid::kWall) touch(x, y), touch(x + 1, y);
                if (down[x] != CornerGrid::kWall) touch(x, y), touch(x, y + 1);
            }
        }
    }

    void join(const CornerGroup& group) {
        std::uint32_t least = kFar;
        for (const std::int32_t c : group)
            least = std::min(least, distance_[static_cast<std::size_t>(c)]);
        for (const std::int32_t c : group)
            distance_[static_cast<std::size_t>(c)] = least;
    }

    // True if any step still improves a distance; marks the columns with such a step.
    bool find_work_on_columns() {
        std::fill(column_works_.begin(), column_works_.end(), std::uint8_t{0});
        std::uint32_t any = 0;
        for (int y = 0; y < grid_.height; ++y) {
            const auto [first, last] = row_hull_[static_cast<std::size_t>(y)];
            const std::uint32_t* d = distance_.data() + at(0, y);
            const std::uint32_t* right = grid_.right.data() + at(0, y);
            const std::uint32_t* down = grid_.down.data() + at(0, y);
            std::uint8_t* work = column_works_.data();
            for (int x = first; x <= last; ++x) {
                const bool better =
                    (d[x] + down[x] < d[x + grid_.stride]) | (d[x + grid_.stride] + down[x] < d[x]);
                work[x] = static_cast<std::uint8_t>(work[x] | better);
            }
            for (int x = first; x < last; ++x) {
                const bool better = (d[x] + right[x] < d[x + 1]) | (d[x + 1] + right[x] < d[x]);
                work[x] = static_cast<std::uint8_t>(work[x] | better);
                work[x + 1] = static_cast<std::uint8_t>(work[x + 1] | better);
            }
        }
        for (const std::uint8_t w : column_works_)
            any |= w;
        return any != 0;
    }

    bool find_work_on_rows(std::vector<std::uint8_t>& work) const {
        bool found = false;
        for (int y = 0; y < grid_.height; ++y) {
            const auto [first, last] = row_hull_[static_cast<std::size_t>(y)];
            const std::uint32_t* d = distance_.data() + at(0, y);
            const std::uint32_t* right = grid_.right.data() + at(0, y);
            const std::uint32_t* down = grid_.down.data() + at(0, y);
            std::uint32_t along = 0, across = 0;
            for (int x = first; x <= last; ++x) {
                across |=
                    (d[x] + down[x] < d[x + grid_.stride]) | (d[x + grid_.stride] + down[x] < d[x]);
            }
            for (int x = first; x < last; ++x)
                along |= (d[x] + right[x] < d[x + 1]) | (d[x + 1] + right[x] < d[x]);
            const auto i = static_cast<std::size_t>(y);
            work[i] = static_cast<std::uint8_t>(work[i] | along | across);
            if (across && y + 1 < grid_.height) work[i + 1] = 1;
            found |= work[i] != 0;
        }
        return found;
    }

    // Takes the distances that the line before offers, then settles each line both ways.
    void pass(const Lines& lines, const std::vector<Hull>& hulls,
              const std::vector<std::uint8_t>& work, bool backward) {
        bool changed = false;
        for (int i = 0; i < lines.count; ++i) {
            const int line = backward ? lines.count - 1 - i : i;
            const auto index = static_cast<std::size_t>(line);
            if (!changed && !work[index]) continue;
            const Hull hull = hulls[index];
            const std::ptrdiff_t start = at(0, 0) + line * lines.across;
            std::uint32_t* d = distance_.data() + start;
            const std::ptrdiff_t before = backward ? lines.across : -lines.across;
            const std::uint32_t* cost = lines.across_cost + start + (backward ? 0 : -lines.across);
            changed =
                settle(lines, hull.first, hull.last, d, d + before, cost, lines.along_cost + start);
        }
    }

    // Inlined for each of the two layouts.
    static bool settle(const Lines& lines, int first, int last, std::uint32_t* d,
                       const std::uint32_t* before, const std::uint32_t* across,
                       const std::uint32_t* along) {
        return lines.along == 1
                   ? settle_line(std::ptrdiff_t{1}, first, last, d, before, across, along)
                   : settle_line(lines.along, first, last, d, before, across, along);
    }

    [[gnu::always_inline]] static inline bool settle_line(std::ptrdiff_t n, int first, int last,
                                                          std::uint32_t* d,
                                                          const std::uint32_t* before,
                                                          const std::uint32_t* across,
                                                          const std::uint32_t* along) {
        std::uint32_t changed = 0;
        if (last < first) return false;
        std::uint32_t best = kFar;
        std::ptrdiff_t i = first * n;
        for (int k = first; k <= last; ++k, i += n) {
            const std::uint32_t offered = std::min(d[i], before[i] + across[i]);
            best = std::min(offered, best);
            changed |= best ^ d[i];
            d[i] = best;
            best += along[i];
        }
        i = last * n;
        best = d[i];
        for (int k = last; k > first; --k) {
            i -= n;
            best = std::min(d[i], best + along[i]);
            changed |= best ^ d[i];
            d[i] = best;
        }
        return changed != 0;
    }

    const CornerGrid& grid_;
    Lines rows_, columns_;
    std::vector<std::uint32_t> distance_;
    std::vector<Hull> row_hull_, column_hull_;
    std::vector<std::uint8_t> column_works_;
};

}  // namespace

CornerDistances distances_by_passes(const CornerGrid& grid, const CornerGroup& start,
                                    const CornerGroup& end,
                                    const std::vector<CornerGroup>& groups) {
    Passes passes(grid);
    std::vector<std::uint32_t>& d = passes.distance();
    for (const std::int32_t c : start)
        d[static_cast<std::size_t>(c)] = 0;
    passes.run(groups);
    std::uint32_t value = kFar;
    for (const std::int32_t c : end)
        value = std::min(value, d[static_cast<std::size_t>(c)]);
    CornerDistances out;
    if (value == kFar) return out;
    out.to_end = value;
    out.distance.resize(d.size());
    for (std::size_t i = 0; i < d.size(); ++i)
        out.distance[i] = std::min(d[i], value);
    return out;
}

}  // namespace weft
