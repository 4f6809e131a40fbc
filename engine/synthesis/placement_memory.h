#pragma once
// Avoids visible repetition: copies, repeated steps, places of the sample used before.

#include <vector>

#include "engine/core/geometry.h"

namespace weft {

/// A patch that was laid: atlas pixel p − origin was offered at canvas position p, for p in `rect`.
struct Placed {
    Vec2i origin{0, 0};
    Recti rect;
    [[nodiscard]] Recti from() const {
        return {rect.x0 - origin.x, rect.y0 - origin.y, rect.x1 - origin.x, rect.y1 - origin.y};
    }
};

/// The placements around the next one.
class PlacementMemory {
  public:
    /// `near`: the distance within which repetition is visible. On a torus each placement must be
    /// given once per turn.
    PlacementMemory(std::vector<Placed> earlier, Size near);

    [[nodiscard]] const std::vector<Placed>& earlier() const { return earlier_; }

    /// Of equally good candidates for the patch, those that reuse places of nearby patches least,
    /// and of these the ones whose steps from the neighbours differ most from earlier steps,
    /// because equal steps are visible as a grid of repeats.
    [[nodiscard]] std::vector<Vec2i> least_repetitive(const std::vector<Vec2i>& origins,
                                                      const Recti& rect) const;

  private:
    [[nodiscard]] double reuse(const Placed& next) const;
    [[nodiscard]] int novelty(Vec2i origin) const;
    [[nodiscard]] bool neighbours(Vec2i d) const;

    std::vector<Placed> earlier_;
    Size near_;
    std::vector<Vec2i> steps_;  ///< Between earlier neighbours, sorted.
};

}  // namespace weft
