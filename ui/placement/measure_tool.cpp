// The reference line: its length in repeats sets the scale.
#include <algorithm>
#include <cmath>

#include "ui/canvas/handles.h"
#include "ui/placement/placement.h"

namespace weft::ui {

void measure_tool(Ctx& c, const ViewMap& map, bool hovered, bool active) {
    UiState& s = c.state;
    if (hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    bool over = false;
    if (s.measured) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const ImVec2 a = map.to_screen(s.measured->first), b = map.to_screen(s.measured->second);
        list.AddLine(a, b, IM_COL32(0, 0, 0, 170), c.theme.px(4));
        list.AddLine(a, b, c.theme.accent_hover, c.theme.px(2));
        // A tick at every repeat.
        const float dx = b.x - a.x, dy = b.y - a.y, length = std::max(1.0f, std::hypot(dx, dy));
        const ImVec2 across(-dy / length * c.theme.px(5), dx / length * c.theme.px(5));
        for (int k = 1; k < s.measured_count && s.measured_count <= 60; ++k) {
            const float u = static_cast<float>(k) / static_cast<float>(s.measured_count);
            const ImVec2 p(a.x + u * dx, a.y + u * dy);
            list.AddLine({p.x - across.x, p.y - across.y}, {p.x + across.x, p.y + across.y},
                         c.theme.accent_hover, c.theme.px(1.5f));
        }
        over |= handle(c, map, "line start", s.measured->first, hovered, c.theme.accent_hover) !=
                Grip::kNone;
        over |= handle(c, map, "line end", s.measured->second, hovered, c.theme.accent_hover) !=
                Grip::kNone;
    }
    if (over || any_handle_held(c) || !active || !ImGui::IsMouseClicked(0)) return;
    const Vec2 at = map.to_plate(ImGui::GetIO().MousePos);
    s.measured = {at, at};
    s.handle_held = "line end";
    s.handle_offset = {0, 0};
}

}  // namespace weft::ui
