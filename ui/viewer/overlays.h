#pragma once
// Overlays of the viewer.

#include <string>

#include "ui/base/ctx.h"
#include "ui/canvas/view_map.h"

namespace weft::ui {

/// A line of text on a dark background, legible on any picture.
void picture_pill(Ctx& c, ImDrawList& list, ImVec2 at, const std::string& text, ImU32 color,
                  const char* icon = nullptr);
void draw_mattes(Ctx& c, ImDrawList& list, const ViewMap& map);
/// The plate is shown instead of the result, as a mask is painted over it.
[[nodiscard]] bool paints_over_plate(const Ctx& c);
/// Says at `at` where the painted matte is not that of the document yet.
void draw_matte_state(Ctx& c, ImDrawList& list, ImVec2 at);
void draw_overlay(Ctx& c, ImDrawList& list, const ViewMap& map);
/// The legend of a heat map.
void draw_legend(Ctx& c, ImDrawList& list, ImVec2 min, ImVec2 max);
/// The state line: what the picture shows and what is in progress.
void draw_state(Ctx& c, ImDrawList& list, ImVec2 min, ImVec2 max);
/// The provenance of the pixel under the mouse, while that overlay is on.
void draw_provenance(Ctx& c, ImDrawList& list, const ViewMap& map, bool hovered);

/// Width of the view's controls in a bar of this width; the state of the picture has the rest.
[[nodiscard]] float view_controls_width(const Ctx& c, float width);

}  // namespace weft::ui
