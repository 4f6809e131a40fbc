#include "ui/shell/shell.h"

#include <imgui_internal.h>  // the stack of open pop-ups

#include <algorithm>
#include <cmath>

#include "ui/files/files.h"
#include "ui/inspector/inspector.h"
#include "ui/jobs/jobs.h"
#include "ui/light/light.h"
#include "ui/placement/placement.h"
#include "ui/review/review.h"
#include "ui/shell/bars.h"
#include "ui/shell/command_table.h"
#include "ui/texture/texture.h"
#include "ui/timeline/timeline.h"
#include "ui/viewer/viewer.h"
#include "ui/widgets/widgets.h"
#include "ui/windows/windows.h"

namespace weft {
namespace {

constexpr float kKeysLeast = 96;  // height of the keys area, unscaled

// A press outside of an open menu or list closes it and also does what it was meant for; ImGui by
// itself would only close it. Esc closes the innermost one. Returns true if Esc did.
bool close_popups(UiState& state) {
    ImGuiContext& g = *ImGui::GetCurrentContext();
    const bool pressed = ImGui::IsMouseClicked(0);
    if (pressed) state.closed_popup = 0;
    if (g.OpenPopupStack.empty()) return false;
    if (ImGui::IsKeyPressed(256) && !ImGui::GetIO().WantTextInput) {
        ImGui::ClosePopupToLevel(g.OpenPopupStack.Size - 1, true);
        return true;
    }
    const bool inside = std::any_of(
        g.OpenPopupStack.begin(), g.OpenPopupStack.end(), [&](const ImGuiPopupData& popup) {
            return popup.Window && popup.Window->Rect().Contains(ImGui::GetIO().MousePos);
        });
    if (!pressed || inside) return false;
    state.closed_popup = g.OpenPopupStack[0].PopupId;
    ImGui::ClosePopupToLevel(0, true);
    return false;
}

// The window that fills the screen and holds all panels.
void begin_root(const Theme& t, ImVec2 screen) {
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(screen);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, t.line);
    ImGui::Begin("##root", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                     ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(3);
}

// The unscaled height of the timeline's ruler; on a low screen, unless it was enlarged, the least.
float ruler_height(const UiState& state, bool low, float least) {
    if (low && state.timeline_h <= UiState{}.timeline_h) return least;
    return std::clamp(state.timeline_h, least, 260.0f);
}

}  // namespace

Shell::Shell(EditorSettings& settings, PictureHost& pictures)
    : settings_(settings), pictures_(pictures), commands_(all_commands()) {
    commands_.bind(settings.keys);
    const auto size = [&](const char* name, float& value) {
        if (const auto found = settings.sizes.find(name); found != settings.sizes.end())
            value = std::clamp(static_cast<float>(found->second), 60.0f, 1200.0f);
    };
    size("inspector", state_.inspector_w);
    size("timeline", state_.timeline_h);
    size("drawer", state_.drawer_h);
    size("report", state_.review_h);
    size("strip", state_.strip_h);
    size("keys", state_.keys_h);
    size("sheet", state_.sheet_h);
}

void Shell::set_look(bool dark, bool grey_surround, float scale) {
    const float before = theme_.scale;
    const bool fonts = theme_.regular == nullptr || before != scale;
    Theme next = make_theme(dark, grey_surround, scale);
    if (fonts) {
        load_fonts(next);
    } else {
        next.regular = theme_.regular;
        next.strong = theme_.strong;
        next.small = theme_.small;
        next.title = theme_.title;
        next.display = theme_.display;
    }
    theme_ = next;
    apply_theme(theme_);
    ImGui::GetIO().FontDefault = theme_.regular;
}

void Shell::open_dropped(const std::string& path, const SessionView& view) {
    if (view.modified && !view.project.plate.path.empty()) {
        state_.leave_asked = true;
        state_.leave_then = {LeaveFor::Kind::kPath, path};
        return;
    }
    dropped_.push_back(OpenAny{path});
}

void Shell::ask_to_leave() {
    state_.leave_asked = true;
    state_.leave_then = {};
}

std::vector<Action> Shell::draw(const SessionView& view) {
    actions_ = std::exchange(dropped_, {});
    items_.clear();
    state_.status.clear();
    if (state_.document != view.document) begin_document(state_, view.document);
    for (const std::string& path : view.saved_textures)
        textures_.forget_thumbnails(path);
    Ctx c{view,
          state_,
          settings_,
          theme_,
          pictures_,
          textures_,
          folders_,
          written_,
          commands_,
          actions_,
          recording_ ? &items_ : nullptr,
          job_log,
          dismiss_notice,
          notify,
          act_now,
          {}};
    const bool sheet = state_.palette_open || state_.shortcuts_open || state_.leave_asked ||
                       view.save_question.has_value() ||
                       state_.browser.purpose != BrowserState::Purpose::kNone;
    part("commands");
    const bool escaped = close_popups(state_);
    state_.keys_taken = sheet || escaped || state_.settings_open || state_.history_open ||
                        state_.shot_open || state_.about_open || state_.adding.open;
    if (!sheet && !escaped && !ui::keys_area_shortcut(c) && !ui::nudge_texture(c) &&
        !ui::nudge_warp(c))
        commands_.dispatch(c);
    layout(c);
    part("windows");
    // The strip is hidden elsewhere.
    const bool strip_seen =
        view.open && !state_.panels_hidden &&
        (state_.workspace == Workspace::kLight ||
         (state_.workspace == Workspace::kTexture && view.strip.kind == StripKind::kSuggested));
    if (view.strip.kind != StripKind::kNone && !strip_seen) c.emit(ShowStrip{});
    ui::notices(c);
    ui::tour(c);
    ui::history_window(c);
    ui::settings_window(c);
    ui::adding_window(c);
    ui::shot_window(c);
    ui::shortcut_sheet(c);
    ui::about_window(c);
    ui::save_question(c);
    ui::file_browser(c);
    ui::command_palette(c);
    ui::leave_question(c);
    return std::exchange(actions_, {});
}

void Shell::splitter(Ctx& c, const char* name, ImVec2 min, ImVec2 size, bool vertical, float& value,
                     float sign, float least, float most, float standard) {
    // A window of its own: over the panels on both sides, which would take the mouse.
    ImGui::SetCursorScreenPos(min);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleColor(ImGuiCol_ChildBg, IM_COL32_BLACK_TRANS);
    ImGui::BeginChild((std::string(name) + "_window").c_str(), size, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    ImGui::InvisibleButton(name, size);
    c.note(name + 2);
    const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    if (hovered || active)
        ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    if (active) {
        const ImVec2 moved = ImGui::GetIO().MouseDelta;
        value =
            std::clamp(value + sign * (vertical ? moved.x : moved.y) / theme_.scale, least, most);
    }
    if (hovered && ImGui::IsMouseDoubleClicked(0)) value = standard;
    if (ImGui::IsItemDeactivated()) settings_.sizes[name + 2] = static_cast<double>(value);
    if (hovered || active) {
        const ImVec2 max(min.x + size.x, min.y + size.y);
        const float mid_x = (min.x + max.x) / 2, mid_y = (min.y + max.y) / 2;
        const float half = theme_.splitter / 4;
        if (vertical)
            ImGui::GetWindowDrawList()->AddRectFilled({mid_x - half, min.y}, {mid_x + half, max.y},
                                                      theme_.accent);
        else
            ImGui::GetWindowDrawList()->AddRectFilled({min.x, mid_y - half}, {max.x, mid_y + half},
                                                      theme_.accent);
    }
    ImGui::EndChild();
}

void Shell::layout(Ctx& c) {
    const Theme& t = theme_;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    begin_root(t, screen);
    const auto at = [](float x, float y) { ImGui::SetCursorScreenPos({x, y}); };
    const float top = t.px(40), bottom = t.px(26);
    const bool panels = !state_.panels_hidden;
    part("top bar");
    at(0, 0);
    ui::top_bar(c, {screen.x, top});
    part("status bar");
    at(0, screen.y - bottom);
    ui::status_bar(c, {screen.x, bottom});
    const float body_h = std::max(t.px(80), screen.y - top - bottom);
    if (!c.view.open) {
        part("welcome");
        at(0, top);
        ui::welcome(c, {screen.x, body_h});
        ImGui::End();
        return;
    }
    if (state_.workspace == Workspace::kJobs) {
        part("jobs page");
        at(0, top);
        ui::jobs_page(c, {screen.x, body_h});
        ImGui::End();
        return;
    }
    const float most_w = std::max(220.0f, screen.x / t.scale * 0.45f);
    state_.inspector_w = std::clamp(state_.inspector_w, 240.0f, most_w);
    const float inspector_w = panels ? std::floor(t.px(state_.inspector_w)) : 0;
    const float tools_w = panels ? t.px(44) : 0;
    // On a low screen, give the picture priority.
    const bool low = screen.y / t.scale < 800;
    const float timeline_least = low ? 84.0f : 96.0f;
    const float ruler_h = panels ? std::floor(t.px(ruler_height(state_, low, timeline_least))) : 0;
    // The keys lie below the ruler, which they share.
    const float keys_most = std::max(kKeysLeast, body_h / t.scale * 0.5f);
    state_.keys_h = std::clamp(state_.keys_h, kKeysLeast, keys_most);
    const float keys_h = panels && state_.keys.open ? std::floor(t.px(state_.keys_h)) : 0;
    const float timeline_h = ruler_h + keys_h;
    const bool drawer = panels && state_.workspace == Workspace::kTexture;
    const bool report = panels && state_.workspace == Workspace::kReview;
    const bool four = state_.viewer.compare == Compare::kFourUp;
    // The four-up view needs the room of the strip.
    const bool strip =
        panels && state_.workspace == Workspace::kLight && !(four && screen.y / t.scale < 1100);
    const bool sheet = strip && state_.sheet();
    const float least_view = t.px(120);
    float extra_h = drawer   ? t.px(state_.drawer_h)
                    : report ? t.px(state_.review_h)
                    : strip  ? t.px(sheet ? state_.sheet_h : state_.strip_h)
                             : 0;
    // By default the picture keeps more than half of the height; the user may enlarge the panels.
    const UiState fresh;
    const float room = std::max(0.0f, body_h - timeline_h - least_view);
    const bool own_size = (drawer && state_.drawer_h > fresh.drawer_h) ||
                          (strip && !sheet && state_.strip_h > fresh.strip_h) || sheet ||
                          (report && state_.review_h > fresh.review_h);
    if (!own_size) extra_h = std::min({extra_h, room, (low ? 0.34f : 0.36f) * body_h});
    extra_h = std::floor(std::clamp(extra_h, 0.0f, room));
    const float left_w = screen.x - inspector_w - (panels ? 1 : 0);
    const float view_h = body_h - timeline_h - extra_h;
    if (panels) {
        part("tools");
        at(0, top);
        ui::tool_strip(c, {tools_w, view_h});
    }
    part("viewer");
    at(tools_w + (panels ? 1 : 0), top);
    ui::viewer(c, {left_w - tools_w - (panels ? 1 : 0), view_h});
    if (drawer) {
        part("texture drawer");
        at(0, top + view_h);
        ui::texture_drawer(c, {left_w, extra_h});
    }
    if (report) {
        part("review");
        at(0, top + view_h);
        ui::review_panel(c, {left_w, extra_h});
    }
    if (strip) {
        part("strip");
        at(0, top + view_h);
        ui::strip_panel(c, {left_w, extra_h});
    }
    if (panels) {
        part("timeline");
        at(0, top + view_h + extra_h);
        ui::timeline(c, {left_w, ruler_h});
        at(0, top + view_h + extra_h + ruler_h);
        if (keys_h > 0) ui::keys_panel(c, {left_w, keys_h});
        part("inspector");
        at(screen.x - inspector_w, top);
        ui::inspector(c, {inspector_w, body_h});
        const float hit = t.splitter_hit;
        splitter(c, "##inspector", {screen.x - inspector_w - hit / 2, top}, {hit, body_h}, true,
                 state_.inspector_w, -1, 240, most_w, 320);
        splitter(c, "##timeline", {0, top + view_h + extra_h - hit / 2}, {left_w, hit}, false,
                 state_.timeline_h, -1, timeline_least, 260, fresh.timeline_h);
        if (keys_h > 0)
            splitter(c, "##keys", {0, top + view_h + extra_h + ruler_h - hit / 2}, {left_w, hit},
                     false, state_.keys_h, -1, kKeysLeast, keys_most, fresh.keys_h);
        if (drawer)
            splitter(c, "##drawer", {0, top + view_h - hit / 2}, {left_w, hit}, false,
                     state_.drawer_h, -1, 150, 900, fresh.drawer_h);
        if (strip)
            splitter(c, "##strip", {0, top + view_h - hit / 2}, {left_w, hit}, false,
                     sheet ? state_.sheet_h : state_.strip_h, -1, 110, sheet ? 900 : 500,
                     sheet ? fresh.sheet_h : fresh.strip_h);
        if (report)
            splitter(c, "##report", {0, top + view_h - hit / 2}, {left_w, hit}, false,
                     state_.review_h, -1, 120, 700, 240);
    }
    ImGui::End();
}

}  // namespace weft
