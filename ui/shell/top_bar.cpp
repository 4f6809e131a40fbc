// The top bar: menus, project name, workspaces and backend.
#include <cmath>

#include "ui/base/icons.h"
#include "ui/files/files.h"
#include "ui/jobs/job_words.h"
#include "ui/shell/bars.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

void menu_item(Ctx& c, const char* id, const char* separate_before = nullptr) {
    const Command* command = c.commands.find(id);
    if (!command) return;
    if (separate_before) ImGui::Separator();
    const bool enabled = !command->enabled || command->enabled(c);
    const bool checked = command->checked && command->checked(c);
    if (ImGui::MenuItem(command->name.c_str(), chord_text(command->key).c_str(), checked, enabled))
        command->run(c);
    c.note(command->name, enabled);
}

// Saved projects, the newest first, told apart by their folders.
void recent_menu(Ctx& c) {
    const bool any = !c.view.recent.empty();
    const bool open = ImGui::BeginMenu("Open recent", any);
    c.note("Open recent", any);
    if (!open) return;
    for (const std::string& path : c.view.recent) {
        const std::size_t slash = path.find_last_of('/');
        const std::string name = path.substr(slash + 1), folder = path.substr(0, slash);
        ImGui::PushID(path.c_str());
        if (ImGui::MenuItem(name.c_str(), fitted(folder, c.theme.px(280), true).c_str()))
            leave_for(c, {LeaveFor::Kind::kPath, path});
        c.note("Recent " + name);
        ImGui::PopID();
    }
    ImGui::EndMenu();
}

void menu(Ctx& c, const char* name, std::initializer_list<const char*> ids) {
    const Theme& t = c.theme;
    ImGui::PushID(name);
    const ImVec2 size(ImGui::CalcTextSize(name).x + t.px(16), t.px(28));
    ImGui::InvisibleButton("##menu", size);
    c.note(name);
    // Opens when pressed, so that one drag chooses an item; with a menu open, the mouse over
    // another one's name opens that.
    const ImGuiID popup = ImGui::GetID("##open");
    if (ImGui::IsItemClicked() && c.state.closed_popup != popup) ImGui::OpenPopup("##open");
    const bool other_open = !c.state.open_menu.empty() && c.state.open_menu != name;
    if (other_open && ImGui::IsMouseHoveringRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax()))
        ImGui::OpenPopup("##open");
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool open = ImGui::IsPopupOpen("##open");
    if (open || ImGui::IsItemHovered()) list.AddRectFilled(min, max, t.hover, t.radius);
    text_in(list, t.regular, min, max, t.text, name);
    ImGui::SetNextWindowPos({min.x, max.y + t.px(2)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {t.px(6), t.px(6)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {t.px(12), t.px(7)});
    if (ImGui::BeginPopup("##open")) {
        c.state.open_menu = name;
        const PanelName within(c, "Menu");
        for (const char* id : ids) {
            if (std::string_view(id) == "-")
                ImGui::Separator();
            else if (std::string_view(id) == "recent")
                recent_menu(c);
            else
                menu_item(c, id);
        }
        ImGui::EndPopup();
    } else if (c.state.open_menu == name) {
        c.state.open_menu.clear();
    }
    ImGui::PopStyleVar(2);
    ImGui::PopID();
    ImGui::SameLine(0, 0);
}

void menus(Ctx& c) {
    menu(c, "File",
         {"file.new", "file.open", "recent", "file.demo", "-", "file.save", "file.save_as",
          "file.save_version", "-", "file.collect", "file.relink", "file.textures", "-",
          "file.close", "file.quit"});
    menu(c, "Edit",
         {"edit.undo", "edit.redo", "edit.history", "-", "edit.palette", "edit.shot",
          "edit.settings"});
    menu(c, "View",
         {"view.fit",
          "view.actual",
          "view.squeezed",
          "-",
          "view.plate",
          "view.wipe",
          "view.difference",
          "view.side",
          "view.four",
          "-",
          "view.store",
          "-",
          "view.mattes",
          "view.onion",
          "view.seams",
          "view.light",
          "view.light_confidence",
          "view.grid",
          "view.stretch",
          "view.arrows",
          "view.trust",
          "view.pieces",
          "-",
          "view.reset",
          "view.panels",
          "view.second",
          "view.fullscreen",
          "view.layout"});
    menu(c, "Region",
         {"region.add", "region.duplicate", "region.remove", "-", "region.solo", "region.key",
          "region.clear", "region.reference", "-", "analysis.pause"});
    menu(c, "Render", {"render.submit"});
    menu(c, "Help", {"help.tour", "help.shortcuts", "edit.palette", "help.about"});
}

void workspace_tabs(Ctx& c, ImVec2 origin, float left, float right) {
    const Theme& t = c.theme;
    const char* const glyphs[] = {icons::kBrush, icons::kTexture, icons::kMotion,
                                  icons::kLight, icons::kReview,  icons::kJobs};
    static const char* const ids[] = {"workspace.mask",  "workspace.texture", "workspace.motion",
                                      "workspace.light", "workspace.review",  "workspace.jobs"};
    const bool with_icons = right - left > t.px(620);
    const float icon_w = with_icons ? t.px(20) : 0;
    float widths[kWorkspaceCount], total = 0;
    for (int k = 0; k < kWorkspaceCount; ++k) {
        widths[k] = ImGui::CalcTextSize(workspace_name(static_cast<Workspace>(k))).x + icon_w +
                    t.px(with_icons ? 26 : 18);
        total += widths[k];
    }
    float x = std::floor(std::max(left, (left + right - total) * 0.5f));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int k = 0; k < kWorkspaceCount; ++k) {
        const auto w = static_cast<Workspace>(k);
        ImGui::SetCursorScreenPos({x, origin.y});
        ImGui::PushID(k);
        if (ImGui::InvisibleButton("##tab", {widths[k], t.px(40)})) set_workspace(c.state, w);
        ImGui::PopID();
        c.note(workspace_name(w));
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        const bool on = c.state.workspace == w;
        const ImU32 color = on ? t.text : ImGui::IsItemHovered() ? t.text : t.quiet;
        if (with_icons)
            icon_in(c, list, {min.x + t.px(10), min.y}, {min.x + t.px(28), max.y},
                    on ? t.accent_hover : color, glyphs[k]);
        text_in(list, on ? t.strong : t.regular,
                {min.x + icon_w + t.px(with_icons ? 13 : 9), min.y}, max, color, workspace_name(w),
                0);
        if (on)
            list.AddRectFilled({min.x + t.px(8), max.y - t.px(2)}, {max.x - t.px(8), max.y},
                               t.accent);
        tooltip(c, "", ids[k]);
        x += widths[k];
    }
}

// What was last said, whole under the mouse.
void last_message(Ctx& c, ImVec2 min, ImVec2 max) {
    const Theme& t = c.theme;
    const std::string last = !c.state.status.empty()   ? c.state.status
                             : !c.view.notices.empty() ? c.view.notices.back().text
                                                       : "";
    const float room = max.x - min.x;
    if (last.empty() || room < t.px(60)) return;
    ImGui::PushFont(t.small);
    const std::string shown = fitted(last, room);
    text_in(*ImGui::GetWindowDrawList(), t.small, min, max, t.quiet, shown.c_str(), 0);
    ImGui::PopFont();
    ImGui::SetCursorScreenPos(min);
    ImGui::InvisibleButton("##last", {room, max.y - min.y});
    c.note("Last message");
    if (shown != last) tooltip(c, last.c_str());
}

}  // namespace

void top_bar(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    begin_panel(c, "Top", size, t.panel, false, 0);
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({origin.x + t.px(6), origin.y + t.px(6)});
    menus(c);
    const float after_menus = ImGui::GetItemRectMax().x;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    // The project's name, with a dot if there are unsaved changes.
    float name_right = after_menus;
    if (c.view.open) {
        const float room =
            std::max(t.px(110), size.x * 0.5f - t.px(330) - (after_menus - origin.x));
        const std::string name = fitted(c.view.title, std::min(room, t.px(220)) - t.px(24));
        const ImVec2 at(after_menus + t.px(12), origin.y);
        text_in(list, t.strong, at, {at.x + room, origin.y + size.y}, t.quiet, name.c_str(), 0);
        name_right = at.x + ImGui::CalcTextSize(name.c_str()).x + t.px(16);
        if (c.view.modified)
            list.AddCircleFilled({name_right - t.px(4), origin.y + size.y * 0.5f}, t.px(3), t.warn,
                                 12);
        name_right += t.px(8);
    }
    const float right = origin.x + size.x - t.px(108);
    if (c.view.open) workspace_tabs(c, origin, name_right, right);
    // Backend and settings.
    ImGui::SetCursorScreenPos({origin.x + size.x - t.px(38), origin.y + t.px(6)});
    if (icon_button(c, icons::kSettings, "Settings", c.state.settings_open, "edit.settings"))
        c.commands.run("edit.settings", c);
    const ImVec2 chip_min(right + t.px(8), origin.y + t.px(10));
    const ImVec2 chip_max(right + t.px(66), origin.y + size.y - t.px(10));
    list.AddRectFilled(chip_min, chip_max, t.field, t.radius);
    list.AddCircleFilled({chip_min.x + t.px(10), (chip_min.y + chip_max.y) * 0.5f}, t.px(3), t.good,
                         12);
    text_in(list, t.small, {chip_min.x + t.px(16), chip_min.y}, chip_max, t.quiet,
            c.view.backend.c_str());
    ImGui::SetCursorScreenPos(chip_min);
    ImGui::InvisibleButton("##backend", {chip_max.x - chip_min.x, chip_max.y - chip_min.y});
    tooltip(c, "The preview uses this backend. Renders use the best one available");
    list.AddLine({origin.x, origin.y + size.y - 1}, {origin.x + size.x, origin.y + size.y - 1},
                 t.line);
    end_panel(c);
}

void status_bar(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    begin_panel(c, "Status", size, t.panel, false, 0);
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine(origin, {origin.x + size.x, origin.y}, t.line);
    float x = origin.x + t.px(10);
    const float bottom = origin.y + size.y;
    const auto cell = [&](const std::string& text, float width, ImU32 color) {
        // A longer text takes the room of what follows, which would be written over it.
        const float written = t.small->CalcTextSizeA(t.small->FontSize, FLT_MAX, 0, text.c_str()).x;
        width = std::max(width, written + t.px(10));
        if (x + width > origin.x + size.x - t.px(8)) return;
        c.note("Status: " + text, {x, origin.y}, {x + width, bottom});
        text_in(list, t.small, {x, origin.y}, {x + width, bottom}, color, text.c_str(), 0);
        x += width;
        list.AddLine({x, origin.y + t.px(7)}, {x, bottom - t.px(7)}, faded(t.off, 0.6f));
        x += t.px(10);
    };
    const SessionView& v = c.view;
    if (v.open && v.plate.state == PlateView::State::kOpen) {
        cell("Frame " + std::to_string(v.frame), t.px(84), t.text);
        const ViewerState& view = c.state.viewer;
        char pixel[96] = "";
        if (view.pixel) {
            std::snprintf(pixel, sizeof pixel, "%d, %d   %.3f  %.3f  %.3f", view.pixel->x,
                          view.pixel->y, static_cast<double>(view.value.x),
                          static_cast<double>(view.value.y), static_cast<double>(view.value.z));
        }
        cell(pixel[0] ? pixel : "x, y   red  green  blue", t.px(200), pixel[0] ? t.text : t.off);
        cell(std::to_string(v.plate.size.width) + " × " + std::to_string(v.plate.size.height) +
                 ", " + v.plate.depth,
             t.px(140), t.quiet);
        ImGui::PushFont(t.small);
        const std::string spaces = fitted(v.plate.space + " → " + v.screen_name.view, t.px(144));
        const float spaces_w = std::max(t.px(104), ImGui::CalcTextSize(spaces.c_str()).x + t.px(8));
        ImGui::PopFont();
        cell(spaces, spaces_w, t.quiet);
        int cached = 0;
        for (const FrameMarks& mark : v.marks)
            cached += mark.plate;
        cell("Cached " + std::to_string(cached) + "/" + std::to_string(v.marks.size()), t.px(106),
             t.quiet);
        if (v.playing && v.play_fps > 0)
            cell(number_text(v.play_fps, 1) + " fps", t.px(60),
                 v.play_fps > 0.95 * v.plate.fps ? t.quiet : t.warn);
    }
    for (const JobView& job : v.jobs) {
        const bool paused = job.state == JobState::kPaused;
        if (job.state == JobState::kRunning || paused)
            cell(job_summary(job), t.px(paused ? 130 : 210), paused ? t.warn : t.accent_hover);
    }
    if (v.preview.analysing && v.preview.total > 0) {
        cell("Analysing " + percent_text(v.preview.done, v.preview.total), t.px(124),
             t.accent_hover);
    }
    last_message(c, {x, origin.y}, {origin.x + size.x - t.px(10), bottom});
    end_panel(c);
}

void tool_strip(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    begin_panel(c, "Tools", size, t.panel, false, t.px(6));
    // Tools of this workspace; shortcuts of tools work everywhere.
    static const std::vector<const char*> kTools[] = {
        {"tool.pan", "tool.brush", "tool.eraser", "tool.lasso", "tool.polygon", "tool.shape",
         "tool.flood", "tool.scribble", "tool.confirm", "tool.crypto", "tool.snap"},
        {"tool.pan", "tool.place", "tool.warp", "tool.form", "tool.measure", "tool.similar",
         "tool.snap"},
        {"tool.pan", "tool.pin", "tool.place"},
        {"tool.pan", "tool.lamp", "tool.keep", "tool.place"},
        {"tool.pan"},
        {}};
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, t.px(4)});
    std::vector<const char*> tools = kTools[static_cast<int>(c.state.workspace)];
    if (c.state.workspace == Workspace::kMotion && is_zone_layer(c.view.matte_layer))
        tools.insert(tools.end(), {"tool.brush", "tool.eraser", "tool.lasso", "tool.polygon"});
    for (const char* id : tools) {
        const Command* command = c.commands.find(id);
        if (icon_button(c, command->icon, command->name.c_str(), command->checked(c), id, true,
                        t.px(32)))
            command->run(c);
    }
    ImGui::Dummy({0, t.px(6)});
    if (icon_button(c, icons::kUndo, "Undo", false, "edit.undo", !c.view.undo_label.empty(),
                    t.px(32)))
        c.emit(Undo{});
    if (icon_button(c, icons::kRedo, "Redo", false, "edit.redo", !c.view.redo_label.empty(),
                    t.px(32)))
        c.emit(Redo{});
    ImGui::PopStyleVar();
    end_panel(c);
}

}  // namespace weft::ui
