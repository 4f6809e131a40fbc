// The rectangle for which similar textures are searched.
#include <algorithm>

#include "ui/texture/texture.h"

namespace weft::ui {

void similar_tool(Ctx& c, const ViewMap& map, bool active) {
    UiState& s = c.state;
    const Vec2 mouse = map.to_plate(ImGui::GetIO().MousePos);
    if (active && ImGui::IsMouseClicked(0)) s.rectangle_from = mouse;
    if (!s.rectangle_from) return;
    const Vec2 a = *s.rectangle_from;
    const ImVec2 p = map.to_screen(a), q = map.to_screen(mouse);
    const ImVec2 min(std::min(p.x, q.x), std::min(p.y, q.y)),
        max(std::max(p.x, q.x), std::max(p.y, q.y));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRect(min, max, IM_COL32(0, 0, 0, 170), 0, 0, c.theme.px(3));
    list.AddRect(min, max, c.theme.accent_hover, 0, 0, c.theme.px(1.5f));
    if (ImGui::IsMouseDown(0)) return;
    s.rectangle_from.reset();
    const Recti part =
        Recti{static_cast<int>(std::min(a.x, mouse.x)), static_cast<int>(std::min(a.y, mouse.y)),
              static_cast<int>(std::max(a.x, mouse.x)), static_cast<int>(std::max(a.y, mouse.y))}
            .intersected(rect_of(c.view.plate.size));
    constexpr int kLeast = 12;
    if (part.width() < kLeast || part.height() < kLeast || !c.view.plate_picture) return;
    s.drawer.similar_key = std::to_string(c.view.document) + " " + std::to_string(c.view.frame) +
                           " " + std::to_string(part.x0) + " " + std::to_string(part.y0) + " " +
                           std::to_string(part.x1) + " " + std::to_string(part.y1);
    s.drawer.similar_frame = c.view.frame;
    s.drawer.similar_file.clear();
    c.textures.find_similar(s.drawer.similar_key, c.view.plate_picture, part);
}

}  // namespace weft::ui
