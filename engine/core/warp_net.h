#pragma once
#include <array>
#include <cstddef>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <vector>

#include "engine/core/grid_warp.h"

namespace weft {

/// The displacement of a grid warp on one frame, from where things lie at rest to where they come
/// to lie: bicubic Bézier patches over the grid, and their continuation beyond its border. Once
/// differentiable everywhere. Immutable and thread-safe.
class WarpNet {
  public:
    /// `points`: warp.count() of them. The corners must be convex.
    WarpNet(const GridWarp& warp, const std::vector<WarpPoint>& points);

    struct Place {
        glm::dvec2 at;
        glm::dmat2 jacobian;  ///< Columns: ∂/∂x and ∂/∂y of the place at rest.
    };
    /// Where a place at rest comes to lie.
    [[nodiscard]] Place moved(glm::dvec2 rest) const;

    /// A place of the grid at rest, (0, 0) to (columns, rows).
    [[nodiscard]] glm::dvec2 rest(glm::dvec2 grid) const;
    /// A place of the moved grid, and its derivatives by column and row.
    struct OnGrid {
        glm::dvec2 at, by_column, by_row;
    };
    [[nodiscard]] OnGrid on_grid(glm::dvec2 grid) const;

    /// Where it has to be known well: the moved grid, and what fades or continues around it.
    struct Box {
        glm::dvec2 low, high;
    };
    [[nodiscard]] Box reach() const;

    /// How far `to` can be followed from this net, both of the same grid at rest, until it folds: 0
    /// to 1. `grid` is where it would, in columns and rows.
    struct Unfolded {
        double share = 1;
        glm::dvec2 grid{0, 0};
    };
    [[nodiscard]] Unfolded unfolded_towards(const WarpNet& to) const;

  private:
    struct Weights {
        int first = 0;  // control point
        std::array<double, 4> at{}, slope{};
    };
    [[nodiscard]] static Weights weights(double along, int patches);
    struct Sum {
        glm::dvec2 at{0, 0}, by_column{0, 0}, by_row{0, 0};
    };
    [[nodiscard]] Sum displacement(glm::dvec2 grid) const;
    [[nodiscard]] Sum displacement(const Weights& u, const Weights& v) const;
    void place_controls(const std::vector<WarpPoint>& points);
    [[nodiscard]] glm::dvec2& control(int i, int j) {
        return controls_[static_cast<std::size_t>(j) * static_cast<std::size_t>(3 * columns_ + 1) +
                         static_cast<std::size_t>(i)];
    }
    [[nodiscard]] std::vector<std::pair<glm::dvec2, glm::dvec2>> samples() const;

    int columns_, rows_;
    Quad<double> corners_;
    double falloff_px_;
    glm::dmat3 rest_from_grid_, grid_from_rest_;
    std::vector<glm::dvec2> controls_;  // displacements, (3 columns + 1) × (3 rows + 1)
};

}  // namespace weft
