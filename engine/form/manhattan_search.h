#pragma once
// The Manhattan frames that the lines of a picture speak for.

#include <functional>
#include <vector>

#include "engine/form/manhattan_frame.h"

namespace weft {

struct ManhattanFit {
    ManhattanFrame frame;
    double gain = 0;         ///< ln, of the lines alone.
    double before = 0;       ///< ln of what was believed, and of the share of it that is left.
    FrameMatrix covariance;  ///< Of a FrameStep.

    /// ln of the posterior's volume, next to no frame at all.
    [[nodiscard]] double evidence() const { return gain + before; }
};

/// Whether a normal (either sign), seen by a lens of that tangent, may be that of the surface.
using NormalTest = std::function<bool(const glm::dvec3& normal, double tangent)>;

/// The most likely frames, best first, none of them twice: a search over normals and lenses, each
/// with the best turn of the other axes by a vote of the lines, then Gauss–Newton steps on the
/// lines that each frame explains. `lens`: what is believed of the tangent before. `possible`
/// decides on the third axis. Evidence is by Laplace's approximation (MacKay 2003, ch. 27).
/// Bit-identical everywhere; thread-safe.
[[nodiscard]] std::vector<ManhattanFit> find_manhattan(const ManhattanLines& lines,
                                                       const TangentBelief& lens,
                                                       const NormalTest& possible);

/// The frame turned about its third axis as explains the lines best.
[[nodiscard]] ManhattanFrame turned_best(const ManhattanLines& lines, const ManhattanFrame& frame);

}  // namespace weft
