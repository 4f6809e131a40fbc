#pragma once
// After the first sweep: further blocks over the worst seams (Kwatra et al. 2003, sections 3.1, 4).

#include <optional>
#include <vector>

#include "engine/core/rng.h"
#include "engine/synthesis/canvas.h"
#include "engine/synthesis/placement_search.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// Refines a filled canvas. Each block is cut into the plane so that its border joins what is there
/// and the seams that it covers vanish: an old seam's pair of pixels has its cost when both stay
/// old, none when both become new. Whatever does not lower the recounted energy is undone, so the
/// energy never rises. Guides take no part. Not thread-safe.
class Refiner {
  public:
    Refiner(ViewU8x3 sample, const PlaneOptions& options, Canvas& canvas, PlaneStats& stats);

    /// One round over the plane's worst blocks. Returns how much energy it took away.
    double pass(int index);

  private:
    [[nodiscard]] std::vector<Vec2i> worst_blocks() const;
    [[nodiscard]] double energy_around(const Recti& rect) const;
    double refine_block(const Recti& rect, Rng& rng);
    [[nodiscard]] std::optional<Vec2i> find_origin(const Block& block, Rng& rng);
    [[nodiscard]] SeamProblem problem_for(const Block& block, Vec2i origin) const;

    ViewU8x3 sample_;
    const PlaneOptions& options_;
    Canvas& canvas_;
    PlaneStats& stats_;
    Size block_, window_;
    std::vector<Vec2i> window_starts_;
    std::vector<std::optional<PlacementSearch>> searches_;
};

}  // namespace weft
