#pragma once
// The overlay of a form's normals.

#include "ui/base/ctx.h"
#include "ui/canvas/view_map.h"

namespace weft::ui {

/// The normals over the picture.
void draw_normals_overlay(Ctx& c, ImDrawList& list, const ViewMap& map, const OverlayPicture& over);
/// Their legend in the picture's upper right corner: a ball in their colours, or that the form is
/// flat.
void draw_normals_legend(Ctx& c, ImDrawList& list, ImVec2 min, ImVec2 max,
                         const OverlayPicture* over);

}  // namespace weft::ui
