// The steps that can be undone, as a list.
#include "ui/parameters/parameters.h"
#include "ui/widgets/sheet.h"
#include "ui/widgets/widgets.h"
#include "ui/windows/windows.h"

namespace weft::ui {
namespace {

// "Set placement.rotate_deg of cloth" → "Rotate texture of cloth"; other settings by their labels.
std::string step_label(const std::string& step) {
    constexpr std::string_view kSet = "Set ", kOf = " of ";
    if (!step.starts_with(kSet) || step.starts_with("Set the ")) return step;
    const std::size_t of = step.find(kOf);
    const std::string key = step.substr(kSet.size(), of - kSet.size());
    const std::string rest = of == std::string::npos ? "" : step.substr(of + kOf.size());
    if (key == "placement.scale") return "Scale texture of " + rest;
    if (key == "placement.rotate_deg") return "Rotate texture of " + rest;
    if (key == "placement.offset_px") return "Move texture of " + rest;
    const std::string label = readable_label(key);
    return rest.empty() ? label : label + " of " + rest;
}

}  // namespace

void history_window(Ctx& c) {
    if (!c.state.history_open) return;
    const Theme& t = c.theme;
    begin_sheet(c, "History", {t.px(380), t.px(480)}, c.state.history_open);
    ImGui::BeginChild("##history", {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, t.px(1)});
    for (std::size_t k = c.view.history.size(); k-- > 0;) {
        const std::string label = k == 0 ? "Opened" : step_label(c.view.history[k]);
        ImGui::PushID(static_cast<int>(k));
        if (ImGui::InvisibleButton("##step", {-FLT_MIN, t.row})) c.emit(GoToHistory{k});
        ImGui::PopID();
        c.note(label);
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const bool now = k == c.view.history_position, later = k > c.view.history_position;
        if (now)
            list.AddRectFilled(min, max, faded(t.accent, 0.3f), t.radius);
        else if (ImGui::IsItemHovered())
            list.AddRectFilled(min, max, t.hover, t.radius);
        text_in(list, t.regular, {min.x + t.px(10), min.y}, max, later ? t.off : t.text,
                fitted(label, max.x - min.x - t.px(20)).c_str(), 0);
    }
    ImGui::PopStyleVar();
    ImGui::EndChild();
    end_sheet(c);
}

}  // namespace weft::ui
