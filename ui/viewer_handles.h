#pragma once
// Internal to the viewer: handles that can be dragged.

#include <array>
#include <optional>
#include <utility>

#include "ui/ctx.h"
#include "ui/view_map.h"

namespace weft::ui {

enum class Grip : std::uint8_t { kNone, kNear, kTaken, kHeld, kLetGo };

/// A draggable dot; `at` follows the mouse during the drag. Ids are unique within a view; at most
/// one handle is dragged.
Grip handle(Ctx& c, const ViewMap& map, const std::string& id, Vec2& at, bool hovered, ImU32 color,
            bool filled = true);
[[nodiscard]] bool any_handle_held(const Ctx& c);
/// Esc takes back what is being dragged on the picture: all is as it was when the drag began.
/// Returns true if something was.
bool take_back_drag(Ctx& c);

/// Alt, or Ctrl and Shift where the window manager keeps Alt: breaks handles, removes a point,
/// begins another shape.
[[nodiscard]] bool breaks_off();
/// The arrow key that was pressed, in pixels: 1, with Shift 10.
[[nodiscard]] Vec2 arrow_step();

/// Whether what is dragged snaps to edges of the plate: the switch, the other way round while Ctrl
/// is held.
[[nodiscard]] bool snaps(const Ctx& c);
/// The place on the nearest strong edge of the plate within 8 px of the screen, which is shown; the
/// place itself while nothing snaps, and where there is none.
[[nodiscard]] Vec2 snapped(Ctx& c, const ViewMap& map, Vec2 at, bool snap);
/// The ends of a segment laid on a straight edge within the same reach; none where there is none.
[[nodiscard]] std::optional<std::pair<Vec2, Vec2>> snapped_segment(Ctx& c, const ViewMap& map,
                                                                   Vec2 from, Vec2 to);

void pin_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);
void lamp_tool(Ctx& c, const ViewMap& map, bool hovered);
void shape_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);
/// The box that rotates and scales the shape. Returns true if a drag has ended that changed it.
bool shape_box(Ctx& c, const ViewMap& map, bool hovered, bool& over);
/// A drag inside of the shape, beside all handles, moves it. Returns true if one has ended that
/// did.
bool shape_inside(Ctx& c, const ViewMap& map, bool active, bool hovered);
void warp_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);
void transform_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);
/// The outline of four corners.
void quad_lines(Ctx& c, const ViewMap& map, const std::array<Vec2, 4>& at);
/// x and y of each corner in turn, to a hundredth of a pixel: more digits only fill the field.
[[nodiscard]] std::vector<double> numbers_of(const std::array<Vec2, 4>& corners);
void form_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);
void scribble_tool(Ctx& c, const ViewMap& map, bool active);
void similar_tool(Ctx& c, const ViewMap& map, bool active);
/// The mouse path of this frame on the plate, so that strokes are smooth at low frame rates.
[[nodiscard]] std::vector<Vec2> path_on_plate(const Ctx& c, const ViewMap& map);

}  // namespace weft::ui
