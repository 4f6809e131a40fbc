#pragma once
// Internal to the viewer: things that are taken hold of on the canvas.

#include "ui/ctx.h"
#include "ui/view_map.h"

namespace weft::ui {

enum class Grip : std::uint8_t { kNone, kNear, kTaken, kHeld, kLetGo };

/// A dot at `at` that can be dragged; `at` follows the mouse while it is held. Ids are unique in a
/// view; one handle at most is held.
Grip handle(Ctx& c, const ViewMap& map, const std::string& id, Vec2& at, bool hovered, ImU32 color,
            bool filled = true);
[[nodiscard]] bool any_handle_held(const Ctx& c);

void pin_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);
void lamp_tool(Ctx& c, const ViewMap& map, bool hovered);
void shape_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);
void scribble_tool(Ctx& c, const ViewMap& map, bool active);
void similar_tool(Ctx& c, const ViewMap& map, bool active);
/// Where the mouse went in this frame, on the plate: frames may be far apart, strokes are not.
[[nodiscard]] std::vector<Vec2> path_on_plate(const Ctx& c, const ViewMap& map);

}  // namespace weft::ui
