#pragma once
// Parts of the viewer: what is drawn over the picture.

#include <string>

#include "ui/ctx.h"
#include "ui/view_map.h"

namespace weft::ui {

/// A line of text on a dark ground, legible on any picture.
void picture_pill(Ctx& c, ImDrawList& list, ImVec2 at, const std::string& text, ImU32 color,
                  const char* icon = nullptr);
void draw_mattes(Ctx& c, ImDrawList& list, const ViewMap& map);
void draw_overlay(Ctx& c, ImDrawList& list, const ViewMap& map);
/// The legend that stands beside every heat picture.
void draw_legend(Ctx& c, ImDrawList& list, ImVec2 min, ImVec2 max);
/// What the picture is, and what is being worked out, in words.
void draw_state(Ctx& c, ImDrawList& list, ImVec2 min, ImVec2 max);
/// Where the pixel under the mouse comes from, while that overlay is on.
void draw_provenance(Ctx& c, ImDrawList& list, const ViewMap& map, bool hovered);

}  // namespace weft::ui
