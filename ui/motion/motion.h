#pragma once
// The Motion workspace: its inspector, and the pins that correct motion.

#include "ui/base/ctx.h"
#include "ui/canvas/view_map.h"

namespace weft::ui {

void motion_inspector(Ctx& c);
/// Makes this frame a reference frame of the selected region, beside those it has.
void add_reference_frame(Ctx& c);
/// Goes to the suggested keyframe after this one, at first to the best; says why there is none.
void go_to_suggested(Ctx& c);
void corrections_section(Ctx& c, const Region& region);
void pin_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);

}  // namespace weft::ui
