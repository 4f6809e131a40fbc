#pragma once
// After the first sweep: further blocks over the worst seams (Kwatra et al. 2003, sections 3.1, 4).

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/rng.h"
#include "engine/synthesis/canvas.h"
#include "engine/synthesis/device_search.h"
#include "engine/synthesis/placement_search.h"
#include "engine/synthesis/plane_lattice.h"
#include "engine/synthesis/sample_atlas.h"
#include "engine/synthesis/texture_plane.h"

namespace weft {

/// ε of the seam cost in refinement, 8-bit units: larger than in the first sweep, so that cuts come
/// nearer to the energy that is counted, ‖A−B‖ alone, and still follow edges.
inline constexpr float kRefineGradientFloor = 64;

/// Refines a filled canvas. Each block is cut into the plane so that its border joins its
/// surroundings and the seams that it covers vanish: an old seam's pair of pixels has its cost if
/// both stay old, none if both become new. A change that does not lower the recounted energy is
/// undone, so the energy never rises. Ignores guides.
class Refiner {
  public:
    /// `device` belongs to the canvas and is updated with every block. Blocks keep to the lattice.
    Refiner(const SampleAtlas& atlas, const PlaneOptions& options, const PlaneLattice& lattice,
            Canvas& canvas, DeviceSearch& device);

    /// One round over the plane's worst places, which lie far enough apart to be refined in
    /// parallel. Returns the energy that it removed, and adds to the refinements and peak bytes.
    double pass(int index, PlaneStats& stats);

  private:
    // A part of the atlas in which one search looks for a block's place.
    struct Window {
        Recti rect;
        Vec2i lo;  ///< Translations go up to 0.
        std::unique_ptr<PlacementSearch> search;
    };
    struct Outcome {
        double gained = 0;
        int laid = 0;
        std::size_t graph_bytes = 0;
    };

    [[nodiscard]] std::vector<Vec2i> worst_blocks(Vec2i shift) const;
    [[nodiscard]] std::vector<Vec2i> apart(const std::vector<Vec2i>& corners) const;
    [[nodiscard]] double energy_around(const Recti& rect) const;
    [[nodiscard]] Outcome refine_block(const Recti& rect, Rng rng);
    void forbid_off_lattice(const Window& window, Vec2i to_canvas,
                            std::vector<Vec2i>& forbidden) const;
    [[nodiscard]] std::optional<Vec2i> find_origin(const Block& block, Rng& rng);
    [[nodiscard]] SeamProblem problem_for(const Block& block, Vec2i origin) const;
    [[nodiscard]] Vec2i source_at(int x, int y) const;

    const SampleAtlas& atlas_;
    const PlaneOptions& options_;
    const PlaneLattice& lattice_;
    Canvas& canvas_;
    DeviceSearch& device_;
    Size block_;
    std::vector<Window> windows_;
};

}  // namespace weft
