#pragma once
// Internal: a smooth vector field on a lattice from weighted measurements, by least squares.

#include <array>
#include <vector>

#include "engine/motion/lattice_field.h"

namespace weft {

/// A symmetric 2×2 matrix.
struct Block {
    double xx = 0, xy = 0, yy = 0;
};

/// Normal equations of the displacements at a lattice's nodes. A measurement at a place acts on the
/// four nodes around it by its bilinear shares; second differences are kept small. Per node a
/// symmetric 2×2 block for itself and for the neighbours to the right and below (the others by
/// symmetry), and the right-hand side. Not thread-safe; deterministic.
class BendingSystem {
  public:
    /// Of `lattice`'s nodes; its displacements do not matter.
    explicit BendingSystem(const LatticeField& lattice)
        : nodes_(lattice.nodes().size()),
          spacing_(lattice.spacing()),
          blocks_(count() * 5),
          rhs_(count()),
          x_(count()) {}

    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(nodes_.width) * static_cast<std::size_t>(nodes_.height);
    }
    /// The measurement own · d = rhs of the displacement d at `p` (frame coordinates, in the
    /// frame).
    void measure(Vec2 p, const Block& own, const glm::dvec2& rhs);
    /// The step x that minimises measurements + stiffness · |second differences of (before + x)|² +
    /// a small multiple of |before + x|², where `before` is the displacement so far; by conjugate
    /// gradients. One value a node, row by row.
    const std::vector<glm::dvec2>& solve(const std::vector<glm::dvec2>& before, double stiffness,
                                         int iterations);

  private:
    void add(std::size_t node, int neighbour, double share, const Block& own) {
        Block& b = blocks_[node * 5 + static_cast<std::size_t>(neighbour)];
        b.xx += share * own.xx;
        b.xy += share * own.xy;
        b.yy += share * own.yy;
    }
    void multiply(const std::vector<glm::dvec2>& x, double stiffness,
                  std::vector<glm::dvec2>& y) const;
    void add_bending(const std::vector<glm::dvec2>& x, double stiffness,
                     std::vector<glm::dvec2>& y) const;
    [[nodiscard]] std::vector<Block> own_inverse(double stiffness) const;

    // Neighbours in the order of `blocks_`: itself, right, below left, below, below right.
    static constexpr std::array<Vec2i, 5> kNeighbours{{{0, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
    // Of the stiffness: what holds the displacement near 0 where nothing else does.
    static constexpr double kPull = 1e-3;

    Size nodes_;
    int spacing_;
    std::vector<Block> blocks_;
    std::vector<glm::dvec2> rhs_, x_;
};

}  // namespace weft
