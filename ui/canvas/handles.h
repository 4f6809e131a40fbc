#pragma once
// What tools on the picture share: handles that can be dragged, lines, modifiers of the mouse.

#include <array>
#include <string>
#include <vector>

#include "engine/core/pixel_aspect.h"
#include "ui/base/ctx.h"
#include "ui/canvas/view_map.h"

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

/// Whether a key is for what is drawn on the picture: no text is typed, and no dialog or menu is in
/// front.
[[nodiscard]] bool keys_for_picture(const Ctx& c);
/// Returns true while the modifier that takes away is held: Ctrl, or Alt, which many window
/// managers keep for moving windows.
[[nodiscard]] bool subtracts();
/// Alt, or Ctrl and Shift where the window manager keeps Alt: breaks handles, removes a point,
/// begins another shape.
[[nodiscard]] bool breaks_off();
/// The arrow key that was pressed, in pixels: 1, with Shift 10.
[[nodiscard]] Vec2 arrow_step();

/// The shape of the plate's pixels.
[[nodiscard]] PixelAspect plate_aspect(const Ctx& c);
/// A circle of the picture unsqueezed: an ellipse while the view shows it squeezed. `radius_px`:
/// unsqueezed.
void plate_circle(Ctx& c, const ViewMap& map, Vec2 middle, float radius_px, ImU32 color,
                  float width);

/// A line between two places of the plate.
void plate_line(Ctx& c, const ViewMap& map, Vec2 from, Vec2 to, ImU32 color);
/// The outline of four corners.
void quad_lines(Ctx& c, const ViewMap& map, const std::array<Vec2, 4>& at);

/// The mouse path of this frame on the plate, so that strokes are smooth at low frame rates.
[[nodiscard]] std::vector<Vec2> path_on_plate(const Ctx& c, const ViewMap& map);

}  // namespace weft::ui
