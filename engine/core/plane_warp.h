#pragma once
#include <vector>

#include "engine/core/geometry.h"
#include "engine/core/warp_net.h"

namespace weft {

/// A grid warp on one frame, the way back: which place at rest has come to lie at a place of the
/// reference frame. Immutable and thread-safe.
class PlaneWarp {
  public:
    /// The warp must not fold (check_grid_warp).
    explicit PlaneWarp(WarpNet net);
    PlaneWarp(const GridWarp& warp, int frame) : PlaneWarp(WarpNet(warp, points_on(warp, frame))) {}

    /// To a few ten-thousandths of a pixel.
    [[nodiscard]] Vec2 rest(Vec2 pixel) const;

  private:
    [[nodiscard]] glm::dvec2 solved(glm::dvec2 pixel, glm::dvec2 start, double enough) const;
    [[nodiscard]] glm::dvec2 start(glm::dvec2 pixel) const;

    WarpNet net_;
    // Displacements to the place at rest, on a lattice over the grid, from which the search begins.
    glm::dvec2 origin_{0, 0};
    double spacing_ = 1;
    Size nodes_;
    std::vector<glm::dvec2> starts_;
};

}  // namespace weft
