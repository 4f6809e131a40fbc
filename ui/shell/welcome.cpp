// The welcome screen.
#include <algorithm>
#include <cmath>

#include "ui/base/icons.h"
#include "ui/shell/bars.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

std::string name_of(const std::string& path) {
    const std::size_t slash = path.find_last_of('/');
    std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
    if (name.ends_with(".weft")) name.resize(name.size() - 5);
    return name;
}

// A large button with an icon, a title and a line below it.
bool large_button(Ctx& c, const char* title, const char* below, const char* icon, ImVec2 size,
                  bool main) {
    const Theme& t = c.theme;
    ImGui::PushID(title);
    const bool pressed = ImGui::InvisibleButton("##card", size);
    ImGui::PopID();
    c.note(title);
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool hovered = ImGui::IsItemHovered();
    list.AddRectFilled(min, max, main ? (hovered ? t.accent_hover : t.accent) : t.raised, t.px(5));
    if (hovered && !main) list.AddRectFilled(min, max, t.hover, t.px(5));
    const ImU32 ink = main ? t.on_accent : t.text;
    icon_in(c, list, {min.x + t.px(6), min.y}, {min.x + t.px(50), max.y}, ink, icon);
    text_in(list, t.strong, {min.x + t.px(54), min.y + t.px(12)}, {max.x, min.y + t.px(34)}, ink,
            title, 0);
    ImGui::PushFont(t.small);
    text_in(list, t.small, {min.x + t.px(54), min.y + t.px(34)}, {max.x, min.y + t.px(52)},
            main ? faded(t.on_accent, 0.8f) : t.quiet, fitted(below, size.x - t.px(62)).c_str(), 0);
    ImGui::PopFont();
    return pressed;
}

}  // namespace

void welcome(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    begin_panel(c, "Welcome", size, t.surround, false, 0);
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const float width = std::min(t.px(880), size.x - t.px(48));
    const float height = t.px(470);
    const float x = std::floor(origin.x + (size.x - width) / 2);
    float y = std::floor(origin.y + std::max(t.px(24), (size.y - height) * 0.42f));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText(t.display, t.display->FontSize, {x, y}, t.text, "Weft");
    text_in(list, t.regular, {x, y + t.px(42)}, {x + width, y + t.px(64)}, t.quiet,
            "New textures on moving surfaces, lit like your plate.", 0);
    y += t.px(92);
    const float column = std::floor((width - t.px(32)) * 0.42f);
    const ImVec2 card_size(column, t.px(64));
    ImGui::SetCursorScreenPos({x, y});
    if (large_button(c, "Open demo shot", "Ready to use: see a result in one click", icons::kPlay,
                     card_size, true))
        c.commands.run("file.demo", c);
    ImGui::SetCursorScreenPos({x, y + t.px(74)});
    if (large_button(c, "Open…", "Frames, a movie or a project", icons::kFolderOpen, card_size,
                     false))
        c.commands.run("file.open", c);
    ImGui::SetCursorScreenPos({x, y + t.px(148)});
    if (large_button(c, "Take the tour", "Six steps, five minutes", icons::kSchool, card_size,
                     false))
        c.commands.run("help.tour", c);
    const ImVec2 drop_min(x, y + t.px(232)), drop_max(x + column, y + t.px(320));
    list.AddRect(drop_min, drop_max, t.off, t.px(5), 0, t.px(1));
    icon_in(c, list, {drop_min.x, drop_min.y + t.px(14)}, {drop_max.x, drop_min.y + t.px(44)},
            t.quiet, icons::kDownload);
    text_in(list, t.regular, {drop_min.x, drop_min.y + t.px(46)},
            {drop_max.x, drop_min.y + t.px(70)}, t.quiet,
            "Or drop a folder, a sequence or a movie");
    // Recent projects.
    const float rx = x + column + t.px(32), rw = width - column - t.px(32);
    list.AddRectFilled({rx, y}, {rx + rw, y + t.px(320)}, t.panel, t.px(5));
    text_in(list, t.strong, {rx + t.px(16), y + t.px(10)}, {rx + rw, y + t.px(34)}, t.text,
            "Recent projects", 0);
    if (c.view.recent.empty()) {
        text_in(list, t.regular, {rx, y + t.px(130)}, {rx + rw, y + t.px(154)}, t.quiet,
                "Saved projects appear here");
        text_in(list, t.small, {rx, y + t.px(154)}, {rx + rw, y + t.px(176)}, t.off,
                "Start with the demo shot");
    }
    float row_y = y + t.px(44);
    for (const std::string& path : c.view.recent) {
        if (row_y + t.px(50) > y + t.px(320)) break;
        ImGui::SetCursorScreenPos({rx + t.px(8), row_y});
        ImGui::PushID(path.c_str());
        if (ImGui::InvisibleButton("##recent", {rw - t.px(16), t.px(48)}))
            c.emit(OpenProject{path});
        ImGui::PopID();
        c.note(name_of(path));
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        list.AddRectFilled(min, max, t.raised, t.px(4));
        if (ImGui::IsItemHovered()) list.AddRectFilled(min, max, t.hover, t.px(4));
        icon_in(c, list, {min.x, min.y}, {min.x + t.px(44), max.y}, t.quiet, icons::kFilm);
        text_in(list, t.strong, {min.x + t.px(46), min.y + t.px(6)}, {max.x, min.y + t.px(26)},
                t.text, name_of(path).c_str(), 0);
        ImGui::PushFont(t.small);
        text_in(list, t.small, {min.x + t.px(46), min.y + t.px(25)}, {max.x, max.y - t.px(4)},
                t.quiet, fitted(path, rw - t.px(72), true).c_str(), 0);
        ImGui::PopFont();
        row_y += t.px(54);
    }
    end_panel(c);
}

}  // namespace weft::ui
