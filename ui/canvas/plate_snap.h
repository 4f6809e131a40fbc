#pragma once
// Edges of the plate that what is dragged snaps to.

#include <optional>
#include <utility>

#include "app/base/picture.h"
#include "engine/core/geometry.h"

namespace weft::ui {

/// A place on an edge of the picture.
struct SnapPlace {
    Vec2 at;              ///< In pixels of the picture.
    bool corner = false;  ///< Two edges meet there.
};

/// The nearest strong edge of the picture within `reach_px`, by the largest gradient across it,
/// between pixels; a corner within reach is preferred. A reach of more than 32 px counts as that.
/// Nothing where the picture has no strong edge. Thread-safe.
[[nodiscard]] std::optional<SnapPlace> snapped_to_edge(const Picture& picture, Vec2 at,
                                                       float reach_px);

/// A segment laid on a straight edge of the picture that runs within `reach_px` along at least 60 %
/// of it, by a least-squares fit of its gradients: the nearest places of the two ends on that line.
/// Nothing if there is no such edge, or the segment is short. Thread-safe.
[[nodiscard]] std::optional<std::pair<Vec2, Vec2>> snapped_to_line(const Picture& picture,
                                                                   Vec2 from, Vec2 to,
                                                                   float reach_px);

}  // namespace weft::ui
