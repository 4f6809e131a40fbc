#pragma once
// Seams: over an overlap of an old and a new picture, which of the two each pixel shows.

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

enum class SeamMethod {
    kGraphCut,            ///< Exact minimum cut (Kwatra et al. 2003).
    kDynamicProgramming,  ///< Minimum-error boundary (Efros & Freeman 2001).
    kNone                 ///< The new picture as it is.
};

/// What a pixel of the overlap window is.
enum class SeamCell : std::uint8_t {
    kOutside,  ///< Not in the overlap: takes no part.
    kFree,     ///< In the overlap, to be decided.
    kOld,      ///< In the overlap and tied to the old side.
    kNew       ///< In the overlap and tied to the new side.
};

/// Costs in integers: arcs between 4-neighbours, `right` from (x, y) to (x+1, y), `down` to
/// (x, y+1), the same in both directions; optional data terms per pixel.
struct SeamProblem {
    Image<SeamCell, 1> cells;
    Image<std::int32_t, 1> right, down;  ///< ≥ 0; read only between two cells that take part.
    Image<std::int32_t, 1> old_cost;     ///< Cost of showing old/new at a pixel; both empty: none.
    Image<std::int32_t, 1> new_cost;
};

/// `labels`: 1 where the new picture shows, 0 the old (0 outside). Of all minimum cuts the one with
/// the fewest old pixels is taken (the minimal source set, old being the source), so every exact
/// solver gives the same labels.
struct SeamResult {
    Image<std::uint8_t, 1> labels;
    std::int64_t energy = 0;
    std::size_t graph_bytes = 0;  ///< Memory that the solver's graph took.
};

/// Cost of the labels under the problem: the arcs between differing labels plus the data terms.
[[nodiscard]] std::int64_t seam_energy(const SeamProblem& problem,
                                       const Image<std::uint8_t, 1>& labels);

/// Exact minimum cut: the shortest path in the planar dual where its conditions hold, max-flow on
/// the grid elsewhere. Pure; thread-safe.
[[nodiscard]] SeamResult solve_seam(const SeamProblem& problem);
/// The two solvers by name, for tests; the first returns nothing where its conditions do not hold.
[[nodiscard]] std::optional<SeamResult> solve_planar_dual(const SeamProblem& problem);
[[nodiscard]] SeamResult solve_grid_maxflow(const SeamProblem& problem);

/// Minimum-error boundary (Efros & Freeman 2001) under the same costs: from every side of the
/// window whose border is tied to the old picture a boundary that is monotone along that side is
/// found by dynamic programming; the new picture shows behind all of them. Ties hold. Never below
/// the minimum cut. The original bounds a boundary's step to one pixel a row; here a step may be
/// longer and pays for it, because overlaps may be ragged. Data terms take no part. Pure;
/// thread-safe.
[[nodiscard]] SeamResult solve_min_error_boundary(const SeamProblem& problem);
/// Direct stitching: the new picture wherever it is not tied to the old one.
[[nodiscard]] SeamResult solve_direct(const SeamProblem& problem);

}  // namespace weft
