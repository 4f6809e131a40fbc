// The command palette.
#include <algorithm>
#include <cmath>

#include "engine/core/text.h"
#include "ui/base/icons.h"
#include "ui/widgets/floating_window.h"
#include "ui/widgets/widgets.h"
#include "ui/windows/windows.h"

namespace weft::ui {
namespace {

// Score of a name for the typed text: all letters in order; beginnings of words count more.
int score(const std::string& name, const std::string& typed) {
    int total = 0;
    std::size_t at = 0;
    for (const char ch : typed) {
        if (ch == ' ') continue;
        const std::size_t found = name.find(ch, at);
        if (found == std::string::npos) return -1;
        total += found == 0 || name[found - 1] == ' ' ? 8 : found == at ? 4 : 1;
        at = found + 1;
    }
    return total * 16 - static_cast<int>(name.size()) / 4;
}

}  // namespace

void command_palette(Ctx& c) {
    if (!c.state.palette_open) return;
    const Theme& t = c.theme;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = std::min(t.px(560), screen.x - t.px(40));
    const std::string typed = lower_case(c.state.palette_text);
    std::vector<std::pair<int, const Command*>> found;
    for (const Command& command : c.commands.all()) {
        if (command.enabled && !command.enabled(c)) continue;
        const int points = score(lower_case(command.name + " " + command.category), typed);
        if (points >= 0) found.emplace_back(points, &command);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    constexpr int kRows = 10;
    const int rows = std::min(kRows, static_cast<int>(found.size()));
    ImGui::SetNextWindowFocus();
    begin_floating(t, "##palette", {std::floor((screen.x - width) / 2), t.px(90)},
                   {width, t.px(62) + t.px(30) * static_cast<float>(std::max(1, rows))},
                   {t.px(12), t.px(12)});
    const PanelName panel(c, "Palette");
    if (!ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();
    if (input(c, "Find a command", c.state.palette_text, "Type a command", -1, icons::kMagnify))
        c.state.palette_at = 0;
    if (ImGui::IsKeyPressed(264)) ++c.state.palette_at;
    if (ImGui::IsKeyPressed(265)) --c.state.palette_at;
    c.state.palette_at = std::clamp(c.state.palette_at, 0, std::max(0, rows - 1));
    const Command* chosen = nullptr;
    const int first = std::max(0, c.state.palette_at - kRows + 1);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    ImGui::Dummy({0, t.px(6)});
    for (int k = first; k < first + rows; ++k) {
        const Command& command = *found[static_cast<std::size_t>(k)].second;
        ImGui::PushID(k);
        if (ImGui::InvisibleButton("##command", {-FLT_MIN, t.px(30)})) chosen = &command;
        ImGui::PopID();
        c.note(command.name);
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        if (k == c.state.palette_at)
            list.AddRectFilled(min, max, faded(t.accent, 0.3f), t.radius);
        else if (ImGui::IsItemHovered())
            list.AddRectFilled(min, max, t.hover, t.radius);
        icon_in(c, list, {min.x + t.px(4), min.y}, {min.x + t.px(28), max.y}, t.quiet,
                command.icon);
        text_in(list, t.regular, {min.x + t.px(34), min.y}, max, t.text, command.name.c_str(), 0);
        const float w = ImGui::CalcTextSize(command.name.c_str()).x;
        text_in(list, t.small, {min.x + t.px(44) + w, min.y}, max, t.off, command.category.c_str(),
                0);
        text_in(list, t.small, min, {max.x - t.px(8), max.y}, t.quiet,
                chord_text(command.key).c_str(), 1);
    }
    ImGui::PopStyleVar();
    if (rows == 0) quiet(c, "No matching command");
    if (ImGui::IsKeyPressed(257) && rows > 0)
        chosen = found[static_cast<std::size_t>(c.state.palette_at)].second;
    const bool outside = ImGui::IsMouseClicked(0) && !ImGui::IsWindowHovered();
    ImGui::End();
    if (chosen || outside || ImGui::IsKeyPressed(256)) c.state.palette_open = false;
    if (chosen) chosen->run(c);
}

}  // namespace weft::ui
