// A minimum cut whose terminals both lie on the outer face of a planar graph is a shortest path in
// the dual (Ford & Fulkerson 1956, Hassin 1981). The pixels of the overlap are the graph; its faces
// are the corners between four pixels. All corners on the overlap's outer border are one face,
// which the ties split: source and sink sit outside and reach their border pixels by arcs of
// infinite capacity, so that every stretch of free border between two ties is a face of its own.
// The two stretches between the old and the new arc are the path's free ends.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/geometry.h"
#include "engine/seam/radix_heap.h"
#include "engine/seam/seam.h"

namespace weft {
namespace {

constexpr std::uint64_t kFar = ~std::uint64_t{0};
constexpr std::int32_t kWall = -1;
constexpr std::array<Vec2i, 4> kForward{Vec2i{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
constexpr std::array<Vec2i, 4> kOutward{Vec2i{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
constexpr std::array<Vec2i, 4> kEndCorner{Vec2i{1, 0}, {1, 1}, {0, 1}, {0, 0}};

bool takes_part(const SeamProblem& p, int x, int y) {
    return x >= 0 && y >= 0 && x < p.cells.width() && y < p.cells.height() &&
           p.cells.at(x, y) != SeamCell::kOutside;
}

// One side of a pixel that faces the outside, met on a clockwise walk (region on the right hand),
// and the corner where it ends.
struct BorderSide {
    SeamCell tie;
    std::int32_t corner;
};

class PlanarDual {
  public:
    explicit PlanarDual(const SeamProblem& problem)
        : p_(problem), w_(problem.cells.width()), h_(problem.cells.height()), stride_(w_ + 2) {}

    std::optional<SeamResult> solve() {
        if (!p_.old_cost.empty() || !walk_border() || !find_runs() || !ties_reach_border()) {
            return std::nullopt;
        }
        build_dual();
        SeamResult result;
        result.energy = static_cast<std::int64_t>(shortest_path());
        result.labels = minimal_source_set();
        result.graph_bytes = bytes();
        return result;
    }

  private:
    // Corners have one row and one column of padding at the top and the left, so that every corner
    // has four neighbours in the arrays.
    [[nodiscard]] std::int32_t corner_index(int x, int y) const {
        return (y + 1) * stride_ + x + 1;
    }

    // Follows the outer border of the first component. False unless that border is all the border
    // there is: then there is one component and it has no hole.
    bool walk_border() {
        std::size_t sides = 0;
        int start_x = -1, start_y = -1;
        for (int y = 0; y < h_; ++y) {
            for (int x = 0; x < w_; ++x) {
                if (!takes_part(p_, x, y)) continue;
                if (start_x < 0) start_x = x, start_y = y;
                for (const Vec2i n : kOutward)
                    sides += takes_part(p_, x + n.x, y + n.y) ? 0 : 1;
            }
        }
        if (sides == 0) return false;
        int x = start_x, y = start_y;
        std::size_t side = 0;
        border_.reserve(sides);
        do {
            const Vec2i f = kForward[side], n = kOutward[side], e = kEndCorner[side];
            border_.push_back({p_.cells.at(x, y), corner_index(x + e.x, y + e.y)});
            if (!takes_part(p_, x + f.x, y + f.y)) {
                side = (side + 1) % 4;
            } else {
                x += f.x, y += f.y;
                if (takes_part(p_, x + n.x, y + n.y)) {
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
    bool find_runs() {
        const std::size_t n = border_.size();
        std::size_t first = 0;
        while (first < n && border_[first].tie == SeamCell::kFree)
            ++first;
        if (first == n) return false;
        run_of_.assign(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(h_ + 2), 0);
        std::vector<std::uint8_t> passes(run_of_.size(), 0);
        for (const BorderSide& s : border_)
            ++passes[static_cast<std::size_t>(s.corner)];
        int changes = 0;
        for (std::size_t k = 0; k < n;) {
            const SeamCell from = border_[(first + k) % n].tie;
            std::vector<std::int32_t> corners;
            do {
                const std::int32_t corner = border_[(first + k) % n].corner;
                if (passes[static_cast<std::size_t>(corner)] == 1) corners.push_back(corner);
                ++k;
            } while (border_[(first + k) % n].tie == SeamCell::kFree);
            const SeamCell to = border_[(first + k) % n].tie;
            if (from == to && corners.size() <= 1) continue;
            runs_.push_back(std::move(corners));
            const auto run = static_cast<std::int32_t>(runs_.size());
            for (const std::int32_t c : runs_.back())
                run_of_[static_cast<std::size_t>(c)] = run;
            if (from == to) continue;
            ++changes;
            (from == SeamCell::kOld ? start_run_ : end_run_) = run;
        }
        return changes == 2;
    }

    // Tied pixels away from the border must hang together with a tied border pixel of their kind;
    // otherwise their terminal is not on the outer face.
    bool ties_reach_border() const {
        Image<std::uint8_t, 1> seen(w_, h_, 0);
        std::vector<Vec2i> stack;
        std::size_t tied = 0, reached = 0;
        for (int y = 0; y < h_; ++y) {
            for (int x = 0; x < w_; ++x) {
                const SeamCell c = p_.cells.at(x, y);
                if (c != SeamCell::kOld && c != SeamCell::kNew) continue;
                ++tied;
                const bool border = std::any_of(kOutward.begin(), kOutward.end(), [&](Vec2i n) {
                    return !takes_part(p_, x + n.x, y + n.y);
                });
                if (!border) continue;
                seen.at(x, y) = 1;
                stack.push_back({x, y});
            }
        }
        while (!stack.empty()) {
            const Vec2i c = stack.back();
            stack.pop_back();
            ++reached;
            for (const Vec2i n : kOutward) {
                const int x = c.x + n.x, y = c.y + n.y;
                if (!takes_part(p_, x, y) || p_.cells.at(x, y) != p_.cells.at(c.x, c.y) ||
                    seen.at(x, y)) {
                    continue;
                }
                seen.at(x, y) = 1;
                stack.push_back({x, y});
            }
        }
        return reached == tied;
    }

    // The cost of stepping from each corner to the right (across a vertical pair of pixels) and
    // down (across a horizontal pair). Two pixels tied to the same side are never parted.
    void build_dual() {
        const std::size_t n = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(h_ + 2);
        step_right_.assign(n, kWall);
        step_down_.assign(n, kWall);
        for (int y = 0; y < h_; ++y) {
            const SeamCell* row = p_.cells.row(y);
            const SeamCell* below = y + 1 < h_ ? p_.cells.row(y + 1) : nullptr;
            for (int x = 0; x < w_; ++x) {
                const SeamCell c = row[x];
                if (c == SeamCell::kOutside) continue;
                if (x + 1 < w_ && can_part(c, row[x + 1])) {
                    step_down_[static_cast<std::size_t>(corner_index(x + 1, y))] =
                        p_.right.row(y)[x];
                }
                if (below && can_part(c, below[x])) {
                    step_right_[static_cast<std::size_t>(corner_index(x, y + 1))] =
                        p_.down.row(y)[x];
                }
            }
        }
    }

    static bool can_part(SeamCell a, SeamCell b) {
        return b != SeamCell::kOutside && (a == SeamCell::kFree || a != b);
    }

    // Dijkstra from the free end that follows the old arc clockwise to the other. Returns the cut's
    // value; distances beyond it are set to it, which makes them flow potentials.
    std::uint64_t shortest_path() {
        distance_.assign(step_right_.size(), kFar);
        RadixHeap heap;
        const auto relax = [&](std::int32_t corner, std::uint64_t d) {
            std::uint64_t& best = distance_[static_cast<std::size_t>(corner)];
            if (d < best) best = d, heap.push(d, corner);
        };
        for (const std::int32_t c : runs_[static_cast<std::size_t>(start_run_ - 1)])
            relax(c, 0);
        std::uint64_t value = kFar;
        while (!heap.empty()) {
            const auto [d, corner] = heap.pop();
            const auto i = static_cast<std::size_t>(corner);
            if (d != distance_[i]) continue;
            const std::int32_t run = run_of_[i];
            if (run == end_run_) {
                value = d;
                break;
            }
            if (run != 0) {
                for (const std::int32_t c : runs_[static_cast<std::size_t>(run - 1)])
                    relax(c, d);
            }
            const auto step = [&](std::int32_t cost, std::int32_t to) {
                if (cost != kWall) relax(to, d + static_cast<std::uint64_t>(cost));
            };
            step(step_right_[i], corner + 1);
            step(step_right_[i - 1], corner - 1);
            step(step_down_[i], corner + stride_);
            step(step_down_[i - static_cast<std::size_t>(stride_)], corner - stride_);
        }
        for (std::uint64_t& d : distance_)
            d = std::min(d, value);
        return value;
    }

    [[nodiscard]] std::int64_t potential(int x, int y) const {
        return static_cast<std::int64_t>(distance_[static_cast<std::size_t>(corner_index(x, y))]);
    }

    // The potentials' differences are a maximum flow from old to new: to the right
    // φ(below) − φ(above), downwards φ(left) − φ(right). What the old ties reach in its residual
    // graph is the minimal source set.
    Image<std::uint8_t, 1> minimal_source_set() const {
        Image<std::uint8_t, 1> labels(w_, h_, 0);
        std::vector<Vec2i> stack;
        for (int y = 0; y < h_; ++y) {
            for (int x = 0; x < w_; ++x) {
                const SeamCell c = p_.cells.at(x, y);
                if (c == SeamCell::kOld) stack.push_back({x, y});
                labels.at(x, y) = c == SeamCell::kFree || c == SeamCell::kNew ? 1 : 0;
            }
        }
        while (!stack.empty()) {
            const Vec2i c = stack.back();
            const int x = c.x, y = c.y;
            stack.pop_back();
            const auto visit = [&](int nx, int ny, std::int64_t capacity, std::int64_t flow) {
                if (labels.at(nx, ny) == 0 || flow >= capacity) return;
                labels.at(nx, ny) = 0;
                stack.push_back({nx, ny});
            };
            if (takes_part(p_, x + 1, y)) {
                visit(x + 1, y, p_.right.at(x, y), potential(x + 1, y + 1) - potential(x + 1, y));
            }
            if (takes_part(p_, x - 1, y)) {
                visit(x - 1, y, p_.right.at(x - 1, y), potential(x, y) - potential(x, y + 1));
            }
            if (takes_part(p_, x, y + 1)) {
                visit(x, y + 1, p_.down.at(x, y), potential(x, y + 1) - potential(x + 1, y + 1));
            }
            if (takes_part(p_, x, y - 1)) {
                visit(x, y - 1, p_.down.at(x, y - 1), potential(x + 1, y) - potential(x, y));
            }
        }
        return labels;
    }

    [[nodiscard]] std::size_t bytes() const {
        return step_right_.size() * (2 * sizeof(std::int32_t) + sizeof(std::uint64_t)) +
               run_of_.size() * sizeof(std::int32_t) + border_.size() * sizeof(BorderSide);
    }

    const SeamProblem& p_;
    const int w_, h_;
    const std::int32_t stride_;
    std::vector<BorderSide> border_;
    std::vector<std::vector<std::int32_t>> runs_;  ///< Corners of each free stretch.
    std::vector<std::int32_t> run_of_;             ///< Per corner: 1 + its stretch, 0 none.
    std::int32_t start_run_ = 0, end_run_ = 0;
    std::vector<std::int32_t> step_right_, step_down_;
    std::vector<std::uint64_t> distance_;
};

}  // namespace

std::optional<SeamResult> solve_planar_dual(const SeamProblem& problem) {
    return PlanarDual(problem).solve();
}

}  // namespace weft
