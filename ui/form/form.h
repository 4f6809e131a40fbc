#pragma once
// The form of a surface: what shows it, and the tool that draws it.

#include <optional>

#include "ui/base/ctx.h"
#include "ui/canvas/view_map.h"

namespace weft::ui {

/// What shows the surface's form, and the tools to draw it.
void form_section(Ctx& c, const Region& region);
void form_tool(Ctx& c, const ViewMap& map, bool hovered, bool active);
/// The (first) reference frame of a region; empty while it is not known.
[[nodiscard]] std::optional<int> reference_of(const Ctx& c, const Region& region);

}  // namespace weft::ui
