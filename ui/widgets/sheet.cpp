#include "ui/widgets/sheet.h"
#include <algorithm>
#include <cmath>

#include "ui/base/icons.h"
#include "ui/widgets/floating_window.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {

// A centred dialog, closed by its button or Esc.
bool begin_sheet(Ctx& c, const char* title, ImVec2 size, bool& open) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const Theme& t = c.theme;
    size.x = std::min(size.x, screen.x - t.px(32));
    size.y = std::min(size.y, screen.y - t.px(32));
    // In front of everything except its own pop-ups.
    if (!ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel))
        ImGui::SetNextWindowFocus();
    begin_floating(t, title,
                   {std::floor((screen.x - size.x) / 2), std::floor((screen.y - size.y) / 2)}, size,
                   {t.px(16), t.px(14)});
    c.panel = title;
    ImGui::PushFont(t.title);
    ImGui::TextUnformatted(title);
    ImGui::PopFont();
    ImGui::SetCursorPos({size.x - t.px(42), t.px(10)});
    if (icon_button(c, icons::kClose, "Close")) open = false;
    ImGui::SetCursorPos({t.px(16), t.px(50)});
    if (ImGui::IsKeyPressed(256) && c.state.rebinding.empty() && !ImGui::IsAnyItemActive())
        open = false;
    return true;
}

void end_sheet(Ctx& c) {
    ImGui::End();
    c.panel.clear();
}

}  // namespace weft::ui
