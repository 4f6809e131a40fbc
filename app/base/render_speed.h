#pragma once
// How fast this machine renders, learned from the renders that it has done.

namespace weft {

/// `speed` after a render estimated at `estimated_s` took `took_s`: half of the correction (on a
/// logarithmic scale), between 1/20 and 20. Pure.
[[nodiscard]] double calibrated_speed(double speed, double estimated_s, double took_s);

}  // namespace weft
