#pragma once
// Seams: which of two pictures, old or new, each pixel of their overlap shows.

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

enum class SeamMethod {
    kGraphCut,            ///< Exact minimum cut (Kwatra et al. 2003).
    kDynamicProgramming,  ///< Minimum-error boundary (Efros & Freeman 2001).
    kNone                 ///< The new picture unchanged.
};

/// The role of a pixel in the overlap window.
enum class SeamCell : std::uint8_t {
    kOutside,  ///< Not in the overlap; ignored.
    kFree,     ///< In the overlap, to be decided.
    kOld,      ///< In the overlap and tied to the old side.
    kNew       ///< In the overlap and tied to the new side.
};

/// Costs in integers: arcs between 4-neighbours, `right` from (x, y) to (x+1, y), `down` to
/// (x, y+1), the same in both directions; optional data terms per pixel.
struct SeamProblem {
    Image<SeamCell, 1> cells;
    Image<std::int32_t, 1> right, down;  ///< ≥ 0; read only between two cells of the overlap.
    Image<std::int32_t, 1> old_cost;     ///< Cost of showing old/new at a pixel; both empty: none.
    Image<std::int32_t, 1> new_cost;
};

/// `labels`: 1 where the new picture shows, 0 the old (0 outside). Of all minimum cuts it is the
/// one with the fewest old pixels (the minimal source set, with old as the source), so every exact
/// solver gives the same labels.
struct SeamResult {
    Image<std::uint8_t, 1> labels;
    std::int64_t energy = 0;
    std::size_t graph_bytes = 0;  ///< Memory of the solver's graph.
};

/// Cost of the labels: the arcs between different labels plus the data terms.
[[nodiscard]] std::int64_t seam_energy(const SeamProblem& problem,
                                       const Image<std::uint8_t, 1>& labels);

/// Exact minimum cut: a shortest path in the planar dual if its conditions hold, else max-flow on
/// the grid. Pure; thread-safe.
[[nodiscard]] SeamResult solve_seam(const SeamProblem& problem);
/// The two solvers, for tests. The first is empty if its conditions do not hold.
[[nodiscard]] std::optional<SeamResult> solve_planar_dual(const SeamProblem& problem);
[[nodiscard]] SeamResult solve_grid_maxflow(const SeamProblem& problem);

/// Minimum-error boundary (Efros & Freeman 2001) with the same costs. For every side of the window
/// whose border is tied to the old picture, dynamic programming finds a boundary that is monotone
/// along that side; the new picture shows behind all of them. Ties hold. Its energy is never below
/// the minimum cut. The original limits a boundary's step to one pixel per row; here a longer step
/// is possible at its cost, because overlaps may be ragged. Ignores data terms. Pure; thread-safe.
[[nodiscard]] SeamResult solve_min_error_boundary(const SeamProblem& problem);
/// Direct stitching: the new picture wherever it is not tied to the old one.
[[nodiscard]] SeamResult solve_direct(const SeamProblem& problem);

}  // namespace weft
