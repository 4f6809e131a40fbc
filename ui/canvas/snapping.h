#pragma once
// Snapping of what is dragged in the viewer to edges of the plate.

#include <optional>
#include <utility>

#include "ui/base/ctx.h"
#include "ui/canvas/view_map.h"

namespace weft::ui {

/// Whether what is dragged snaps to edges of the plate: the switch, the other way round while Ctrl
/// is held.
[[nodiscard]] bool snaps(const Ctx& c);
/// The place on the nearest strong edge of the plate within 8 px of the screen, which is shown; the
/// place itself while nothing snaps, and where there is none.
[[nodiscard]] Vec2 snapped(Ctx& c, const ViewMap& map, Vec2 at, bool snap);
/// The ends of a segment laid on a straight edge within the same reach; none where there is none.
[[nodiscard]] std::optional<std::pair<Vec2, Vec2>> snapped_segment(Ctx& c, const ViewMap& map,
                                                                   Vec2 from, Vec2 to);

}  // namespace weft::ui
