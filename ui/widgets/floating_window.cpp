#include "ui/widgets/floating_window.h"

namespace weft::ui {

void begin_floating(const Theme& theme, const char* id, ImVec2 at, ImVec2 size, ImVec2 padding,
                    ImGuiWindowFlags flags) {
    ImGui::SetNextWindowPos(at);
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, theme.panel);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, theme.px(5));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::Begin(id, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | flags);
    ImGui::PopStyleVar(3);
    ImGui::PopStyleColor();
}

}  // namespace weft::ui
