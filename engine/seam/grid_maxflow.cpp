// Maximum flow on a 4-neighbour grid by two search trees that are kept from one augmentation to the
// next (Boykov & Kolmogorov 2004). The grid is implicit: a pixel's neighbours are found by adding
// an offset, and all state lies in plain arrays with one pixel of padding around them.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/seam/seam.h"

namespace weft {
namespace {

constexpr std::int64_t kInfinite = std::int64_t{1} << 62;

// Where a pixel's parent in its tree lies: one of the four neighbours, its own terminal, or none.
enum Link : std::uint8_t { kRight, kLeft, kDown, kUp, kTerminal, kNothing };
enum Tree : std::uint8_t { kNoTree, kSource, kSink };

constexpr std::uint8_t opposite(std::uint8_t d) {
    return d ^ 1;
}

class GridFlow {
  public:
    explicit GridFlow(const SeamProblem& problem)
        : p_(problem),
          w_(problem.cells.width()),
          h_(problem.cells.height()),
          stride_(w_ + 2),
          offset_{1, -1, stride_, -stride_} {
        const std::size_t n =
            static_cast<std::size_t>(stride_) * (static_cast<std::size_t>(h_) + 2);
        residual_.assign(n, {0, 0, 0, 0});
        terminal_.assign(n, 0);
        parent_.assign(n, kNothing);
        tree_.assign(n, kNoTree);
        depth_.assign(n, 0);
        stamp_.assign(n, 0);
        in_queue_.assign(n, 0);
        load();
    }

    SeamResult solve() {
        SeamResult result;
        run();
        result.energy = flow_;
        result.labels = minimal_source_set();
        result.graph_bytes =
            terminal_.size() *
                (sizeof(residual_[0]) + sizeof(terminal_[0]) + sizeof(parent_[0]) +
                 sizeof(tree_[0]) + sizeof(depth_[0]) + sizeof(stamp_[0]) + sizeof(in_queue_[0])) +
            (queue_.capacity() + orphans_.capacity()) * sizeof(std::int32_t);
        return result;
    }

  private:
    using Node = std::int32_t;

    static std::size_t at(Node n) { return static_cast<std::size_t>(n); }
    [[nodiscard]] Node node(int x, int y) const { return (y + 1) * stride_ + x + 1; }

    // Arcs have the same capacity both ways, so a residual never exceeds twice an int32. A positive
    // terminal residual is what the source can still send, a negative one what the sink can take.
    // The common part of both data terms, and the cost of tied pixels, is spent at the start.
    void load() {
        const bool data = !p_.old_cost.empty();
        for (int y = 0; y < h_; ++y) {
            for (int x = 0; x < w_; ++x) {
                const SeamCell c = p_.cells.at(x, y);
                if (c == SeamCell::kOutside) continue;
                const Node n = node(x, y);
                if (x + 1 < w_ && p_.cells.at(x + 1, y) != SeamCell::kOutside) {
                    const auto cap = static_cast<std::uint32_t>(p_.right.at(x, y));
                    residual_[at(n)][kRight] = cap;
                    residual_[at(n + 1)][kLeft] = cap;
                }
                if (y + 1 < h_ && p_.cells.at(x, y + 1) != SeamCell::kOutside) {
                    const auto cap = static_cast<std::uint32_t>(p_.down.at(x, y));
                    residual_[at(n)][kDown] = cap;
                    residual_[at(n + stride_)][kUp] = cap;
                }
                const std::int64_t old_cost = data ? p_.old_cost.at(x, y) : 0;
                const std::int64_t new_cost = data ? p_.new_cost.at(x, y) : 0;
                switch (c) {
                    case SeamCell::kOld:
                        terminal_[at(n)] = kInfinite;
                        flow_ += old_cost;
                        break;
                    case SeamCell::kNew:
                        terminal_[at(n)] = -kInfinite;
                        flow_ += new_cost;
                        break;
                    default:
                        terminal_[at(n)] = new_cost - old_cost;
                        flow_ += std::min(old_cost, new_cost);
                }
            }
        }
    }

    void run() {
        for (int y = 0; y < h_; ++y) {
            for (int x = 0; x < w_; ++x) {
                const Node n = node(x, y);
                if (terminal_[at(n)] == 0) continue;
                tree_[at(n)] = terminal_[at(n)] > 0 ? kSource : kSink;
                parent_[at(n)] = kTerminal;
                depth_[at(n)] = 1;
                activate(n);
            }
        }
        while (head_ < queue_.size()) {
            const Node n = queue_[head_];
            if (tree_[at(n)] == kNoTree || !grow(n)) {
                in_queue_[at(n)] = 0;
                ++head_;
                if (head_ > 4096 && head_ * 2 > queue_.size()) {
                    queue_.erase(queue_.begin(),
                                 queue_.begin() + static_cast<std::ptrdiff_t>(head_));
                    head_ = 0;
                }
                continue;
            }
            ++time_;
            while (!orphans_.empty()) {
                const Node orphan = orphans_.back();
                orphans_.pop_back();
                adopt(orphan);
            }
        }
    }

    void activate(Node n) {
        if (in_queue_[at(n)]) return;
        in_queue_[at(n)] = 1;
        queue_.push_back(n);
    }

    // The residual capacity between n and its neighbour in direction d, in the tree's direction:
    // away from the source, or towards the sink.
    [[nodiscard]] std::uint32_t outward(Node n, std::uint8_t d, Tree tree) const {
        return tree == kSource ? residual_[at(n)][d] : residual_[at(n + offset_[d])][opposite(d)];
    }

    // Extends the tree of n by its free neighbours. Augments and returns true if it meets the other
    // tree.
    bool grow(Node n) {
        const auto tree = static_cast<Tree>(tree_[at(n)]);
        for (std::uint8_t d = 0; d < 4; ++d) {
            if (outward(n, d, tree) == 0) continue;
            const Node m = n + offset_[d];
            if (tree_[at(m)] == kNoTree) {
                tree_[at(m)] = tree;
                parent_[at(m)] = opposite(d);
                depth_[at(m)] = depth_[at(n)] + 1;
                stamp_[at(m)] = stamp_[at(n)];
                activate(m);
            } else if (tree_[at(m)] != tree) {
                tree == kSource ? augment(n, d) : augment(m, opposite(d));
                return true;
            } else if (stamp_[at(m)] <= stamp_[at(n)] && depth_[at(m)] > depth_[at(n)] + 1) {
                parent_[at(m)] = opposite(d);
                depth_[at(m)] = depth_[at(n)] + 1;
                stamp_[at(m)] = stamp_[at(n)];
            }
        }
        return false;
    }

    // Sends the flow that fits along the path source … s → t … sink; s and t are neighbours.
    void augment(Node s, std::uint8_t d) {
        const Node t = s + offset_[d];
        std::int64_t room = residual_[at(s)][d];
        Node n = s;
        for (; parent_[at(n)] != kTerminal; n += offset_[parent_[at(n)]]) {
            room = std::min<std::int64_t>(
                room, residual_[at(n + offset_[parent_[at(n)]])][opposite(parent_[at(n)])]);
        }
        room = std::min(room, terminal_[at(n)]);
        for (n = t; parent_[at(n)] != kTerminal; n += offset_[parent_[at(n)]]) {
            room = std::min<std::int64_t>(room, residual_[at(n)][parent_[at(n)]]);
        }
        room = std::min(room, -terminal_[at(n)]);

        const auto units = static_cast<std::uint32_t>(room);
        push(s, d, units);
        for (n = s; parent_[at(n)] != kTerminal;) {
            const std::uint8_t up = parent_[at(n)];
            const Node above = n + offset_[up];
            push(above, opposite(up), units);
            if (residual_[at(above)][opposite(up)] == 0) make_orphan(n);
            n = above;
        }
        terminal_[at(n)] -= room;
        if (terminal_[at(n)] == 0) make_orphan(n);
        for (n = t; parent_[at(n)] != kTerminal;) {
            const std::uint8_t up = parent_[at(n)];
            const Node above = n + offset_[up];
            push(n, up, units);
            if (residual_[at(n)][up] == 0) make_orphan(n);
            n = above;
        }
        terminal_[at(n)] += room;
        if (terminal_[at(n)] == 0) make_orphan(n);
        flow_ += room;
    }

    void push(Node from, std::uint8_t d, std::uint32_t units) {
        residual_[at(from)][d] -= units;
        residual_[at(from + offset_[d])][opposite(d)] += units;
    }

    void make_orphan(Node n) {
        parent_[at(n)] = kNothing;
        orphans_.push_back(n);
    }

    // The number of steps from n to its tree's terminal, or 0 if the path ends in an orphan. Marks
    // a complete path, so that later walks of this round stop at it.
    std::int32_t depth_to_terminal(Node n) {
        std::int32_t steps = 0;
        Node m = n;
        while (stamp_[at(m)] != time_ && parent_[at(m)] != kTerminal) {
            if (parent_[at(m)] == kNothing) return 0;
            m += offset_[parent_[at(m)]];
            ++steps;
        }
        if (stamp_[at(m)] != time_) {
            stamp_[at(m)] = time_;
            depth_[at(m)] = 1;
        }
        const std::int32_t total = steps + depth_[at(m)];
        std::int32_t depth = total;
        for (m = n; stamp_[at(m)] != time_; m += offset_[parent_[at(m)]]) {
            stamp_[at(m)] = time_;
            depth_[at(m)] = depth--;
        }
        return total;
    }

    // Finds the neighbour of the same tree that is nearest to the terminal and has residual
    // capacity. Without one the orphan leaves the tree and its children become orphans.
    void adopt(Node n) {
        const auto tree = static_cast<Tree>(tree_[at(n)]);
        std::int32_t best = std::numeric_limits<std::int32_t>::max();
        std::uint8_t link = kNothing;
        for (std::uint8_t d = 0; d < 4; ++d) {
            const Node m = n + offset_[d];
            if (tree_[at(m)] != tree || outward(m, opposite(d), tree) == 0) continue;
            const std::int32_t depth = depth_to_terminal(m);
            if (depth > 0 && depth < best) best = depth, link = d;
        }
        parent_[at(n)] = link;
        if (link != kNothing) {
            stamp_[at(n)] = time_;
            depth_[at(n)] = best + 1;
            return;
        }
        tree_[at(n)] = kNoTree;
        for (std::uint8_t d = 0; d < 4; ++d) {
            const Node m = n + offset_[d];
            if (tree_[at(m)] != tree) continue;
            if (outward(m, opposite(d), tree) > 0) activate(m);
            if (parent_[at(m)] == opposite(d)) make_orphan(m);
        }
    }

    // The pixels that the source still reaches when no more flow fits.
    Image<std::uint8_t, 1> minimal_source_set() const {
        std::vector<std::uint8_t> reached(terminal_.size(), 0);
        std::vector<Node> stack;
        for (std::size_t n = 0; n < terminal_.size(); ++n) {
            if (terminal_[n] <= 0) continue;
            reached[n] = 1;
            stack.push_back(static_cast<Node>(n));
        }
        while (!stack.empty()) {
            const Node n = stack.back();
            stack.pop_back();
            for (std::uint8_t d = 0; d < 4; ++d) {
                const Node m = n + offset_[d];
                if (residual_[at(n)][d] == 0 || reached[at(m)]) continue;
                reached[at(m)] = 1;
                stack.push_back(m);
            }
        }
        Image<std::uint8_t, 1> labels(w_, h_, 0);
        for (int y = 0; y < h_; ++y) {
            for (int x = 0; x < w_; ++x) {
                const bool outside = p_.cells.at(x, y) == SeamCell::kOutside;
                labels.at(x, y) = outside || reached[at(node(x, y))] ? 0 : 1;
            }
        }
        return labels;
    }

    const SeamProblem& p_;
    const int w_, h_;
    const std::int32_t stride_;
    const std::array<std::int32_t, 4> offset_;
    std::vector<std::array<std::uint32_t, 4>> residual_;
    std::vector<std::int64_t> terminal_;
    std::vector<std::uint8_t> parent_, tree_, in_queue_;
    std::vector<std::int32_t> depth_, stamp_;
    std::vector<Node> queue_, orphans_;
    std::size_t head_ = 0;
    std::int32_t time_ = 0;
    std::int64_t flow_ = 0;
};

}  // namespace

SeamResult solve_grid_maxflow(const SeamProblem& problem) {
    return GridFlow(problem).solve();
}

}  // namespace weft
