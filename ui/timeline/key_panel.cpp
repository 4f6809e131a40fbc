// The keys area below the timeline: its tools, and the shortcuts that belong to it.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "ui/base/icons.h"
#include "ui/timeline/key_parts.h"
#include "ui/timeline/timeline.h"
#include "ui/widgets/widgets.h"

namespace weft::ui {
namespace {

// Keys that are no longer there, after an undo or in another region, are not selected.
void prune(Ctx& c, const Region& region, const std::vector<KeyRow>& rows) {
    KeysState& s = c.state.keys;
    if (s.region != region.id) {
        s.selected.clear();
        s.active.reset();
        s.curves.clear();
        s.values.reset();
        s.drag = KeysState::Drag::kNone;
        s.region = region.id;
    }
    if (s.drag == KeysState::Drag::kKeys) return;
    const auto gone = [&](const KeyRef& key) {
        const auto row = std::find_if(rows.begin(), rows.end(),
                                      [&](const KeyRow& r) { return r.id == key.row; });
        return row == rows.end() ||
               std::none_of(row->keys.begin(), row->keys.end(),
                            [&](const KeyMark& mark) { return mark.frame == key.frame; });
    };
    std::erase_if(s.selected, gone);
    if (s.active && gone(*s.active)) s.active.reset();
    std::erase_if(s.curves, [&](const KeyRowId& id) {
        return std::none_of(rows.begin(), rows.end(),
                            [&](const KeyRow& row) { return row.id == id; });
    });
}

void step_to_key(Ctx& c, const std::vector<KeyRow>& rows, int direction) {
    std::optional<int> best;
    for (const KeyRow& row : rows) {
        for (const KeyMark& key : row.keys) {
            const bool beyond = direction > 0 ? key.frame > c.view.frame : key.frame < c.view.frame;
            if (!beyond) continue;
            if (!best || (direction > 0 ? key.frame < *best : key.frame > *best)) best = key.frame;
        }
    }
    if (best) c.emit(GoToFrame{*best});
}

// A small field with a name before it. Returns what was typed when that is finished.
std::optional<double> number_field(Ctx& c, const char* name, double value, int decimals,
                                   float width) {
    const Theme& t = c.theme;
    const std::string id = c.panel + "/" + name;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float name_w = ImGui::CalcTextSize(name).x;
    text_in(*ImGui::GetWindowDrawList(), t.regular, at, {at.x + name_w, at.y + t.row}, t.quiet,
            name, 0);
    ImGui::SetCursorScreenPos({at.x + name_w + t.px(6), at.y});
    const bool typing = c.state.typing == id;
    std::string shown = number_text(value, decimals);
    std::string& text = typing ? c.state.typing_text : shown;
    input(c, name, text, "", width);
    if (ImGui::IsItemActivated()) {
        c.state.typing_text = number_text(value, decimals);
        c.state.typing = id;
    }
    std::optional<double> typed;
    if (typing && ImGui::IsItemDeactivated()) {
        char* end = nullptr;
        const double number = std::strtod(c.state.typing_text.c_str(), &end);
        const bool good = end != c.state.typing_text.c_str() && std::isfinite(number);
        if (good && ImGui::IsItemDeactivatedAfterEdit()) typed = number;
        c.state.typing.clear();
    }
    return typed;
}

void fields_of_key(Ctx& c, const Region& region) {
    KeysState& s = c.state.keys;
    const Theme& t = c.theme;
    if (!s.active || s.drag == KeysState::Drag::kKeys) return;
    const KeyRef key = *s.active;
    ImGui::SameLine(0, t.px(16));
    constexpr double kFarthest = 1e8;
    if (const auto frame = number_field(c, "Frame", key.frame, 0, t.px(64))) {
        const int to = static_cast<int>(std::lround(std::clamp(*frame, -kFarthest, kFarthest)));
        const int by = allowed_move(c, {key}, to - key.frame);
        keep_region(c, region, with_keys_moved(region, {key}, by), "Move key");
        s.active->frame += by;
        s.selected = {*s.active};
    }
    const KeyedNumbers* numbers = numbers_of(region, key.row);
    const NumberKey* there = numbers ? numbers->key(key.frame) : nullptr;
    if (!there || s.active_number >= there->numbers.size()) return;
    ImGui::SameLine(0, t.px(12));
    if (const auto value = number_field(c, "Value", there->numbers[s.active_number], 3, t.px(84)))
        keep_region(c, region, with_key_value(region, key, s.active_number, *value), "Set key");
}

void tools(Ctx& c, const Region& region, const std::vector<KeyRow>& rows, ImVec2 at, float width) {
    const Theme& t = c.theme;
    KeysState& s = c.state.keys;
    ImGui::SetCursorScreenPos({at.x + t.px(8), at.y + t.px(3)});
    if (segments(c, "view", {"Keys", "Curves"}, s.view, t.px(148))) {
        // Curves of unlike units flatten each other: begin with the one that is being worked on.
        s.curves.clear();
        if (s.active && numbers_of(region, s.active->row)) s.curves = {s.active->row};
        s.values.reset();
    }
    ImGui::SameLine(0, t.px(16));
    const float side = t.px(26);
    if (icon_button(c, icons::kChevronLeft, "Previous key", false, "time.previous_key",
                    !rows.empty(), side))
        step_to_key(c, rows, -1);
    ImGui::SameLine(0, t.px(2));
    if (icon_button(c, icons::kChevronRight, "Next key", false, "time.next_key", !rows.empty(),
                    side))
        step_to_key(c, rows, 1);
    ImGui::SameLine(0, t.px(16));
    const auto number = std::find_if(s.selected.begin(), s.selected.end(), [&](const KeyRef& key) {
        return numbers_of(region, key.row) != nullptr;
    });
    const bool any = number != s.selected.end();
    const KeyedNumbers* first = any ? numbers_of(region, number->row) : nullptr;
    const NumberKey* key = first ? first->key(number->frame) : nullptr;
    using Way = std::pair<KeyInterpolation, const char*>;
    for (const auto& [after, name] :
         {Way{KeyInterpolation::kLinear, "Linear"}, Way{KeyInterpolation::kSmooth, "Smooth"},
          Way{KeyInterpolation::kHold, "Hold"}}) {
        if (button(c, name,
                   {.look = key && key->after == after ? Look::kNormal : Look::kQuiet,
                    .enabled = any,
                    .tip = "How the selected keys go to the next ones"}))
            set_interpolation(c, region, after);
        ImGui::SameLine(0, t.px(4));
    }
    ImGui::Dummy({0, 0});
    fields_of_key(c, region);
    ImGui::SetCursorScreenPos({at.x + width - t.px(66), at.y + t.px(3)});
    if (icon_button(c, icons::kFullscreen, "Fit keys (F, Home)", false, nullptr, true, side))
        fit_keys(c);
    ImGui::SameLine(0, t.px(2));
    if (icon_button(c, icons::kClose, "Close keys", false, "time.keys", true, side)) s.open = false;
}

// The wheel with Ctrl zooms the frames about the mouse, in the curves also without; the middle
// button pans.
void navigate_keys(Ctx& c, ImVec2 min, ImVec2 max) {
    KeysState& s = c.state.keys;
    const ImGuiIO& io = ImGui::GetIO();
    const bool over = ImGui::IsMouseHoveringRect(min, max) && ImGui::IsWindowHovered();
    const FrameScale scale = frame_scale(c, min.x, max.x);
    if (over && io.MouseWheel != 0 && (io.KeyCtrl || (s.view == 1 && !io.KeyShift))) {
        const double by = std::pow(0.85, static_cast<double>(io.MouseWheel));
        const double at = scale.at(io.MousePos.x);
        const double low = at + by * (scale.first - at), high = at + by * (scale.last - at);
        constexpr double kLeast = 4, kMost = 1e6;
        if (high - low > kLeast && high - low < kMost) s.frames = {low, high};
    }
    if (over && ImGui::IsMouseClicked(2)) s.drag = KeysState::Drag::kPan;
    if (s.drag != KeysState::Drag::kPan) return;
    if (!ImGui::IsMouseDown(2)) {
        s.drag = KeysState::Drag::kNone;
        return;
    }
    const double dx = static_cast<double>(io.MouseDelta.x / scale.frame_width());
    if (dx != 0) s.frames = {scale.first - dx, scale.last - dx};
    if (s.view == 1 && s.values) {
        auto& [low, high] = *s.values;
        const double dy =
            static_cast<double>(io.MouseDelta.y / std::max(1.0f, max.y - min.y)) * (high - low);
        low += dy;
        high += dy;
    }
}

// Escape takes back a drag.
void cancel_drag(Ctx& c) {
    KeysState& s = c.state.keys;
    if (s.drag == KeysState::Drag::kKeys && (s.by != 0 || s.by_value != 0)) c.drop_tried();
    s.drag = KeysState::Drag::kNone;
    s.by = 0;
    s.by_value = 0;
    s.before.reset();
}

}  // namespace

bool keys_area_shortcut(Ctx& c) {
    KeysState& s = c.state.keys;
    const Region* region = c.view.selected_region();
    if (!s.open || !s.focused || !region || ImGui::GetIO().WantTextInput) return false;
    const KeyChord pressed = pressed_chord(false);
    const auto is = [&](const char* chord) { return pressed == *parse_chord(chord); };
    if (pressed.key == 0) return false;
    if (is("Esc") && s.drag != KeysState::Drag::kNone) {
        cancel_drag(c);
        return true;
    }
    // Nothing else while keys are being dragged.
    if (s.drag == KeysState::Drag::kKeys) return true;
    if (is("F") || is("Home")) {
        fit_keys(c);
    } else if (is("Ctrl+V") && !s.copied.empty()) {
        paste_keys(c, *region);
    } else if (is("Ctrl+C") && !s.selected.empty()) {
        copy_keys(c, *region);
    } else if (is("Ctrl+A")) {
        for (const KeyRow& row : key_rows(*region))
            for (const KeyMark& key : row.keys)
                s.selected.insert({row.id, key.frame});
    } else if (is("Delete") && !s.selected.empty()) {
        delete_keys(c, *region);
    } else {
        return false;
    }
    return true;
}

void keys_panel(Ctx& c, ImVec2 size) {
    const Theme& t = c.theme;
    KeysState& s = c.state.keys;
    begin_panel(c, "Keys", size, t.panel, false, 0);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 end(at.x + size.x, at.y + size.y);
    ImGui::GetWindowDrawList()->AddLine(at, {end.x, at.y}, t.line);
    if (ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1))
        s.focused = ImGui::IsMouseHoveringRect(at, end) && ImGui::IsWindowHovered();
    const Region* region = c.view.selected_region();
    if (!region || c.view.plate.frames.empty()) {
        text_in(*ImGui::GetWindowDrawList(), t.regular, at, end, t.off,
                "Select a region to see its keys");
        end_panel(c);
        return;
    }
    const std::vector<KeyRow> rows = key_rows(*region);
    prune(c, *region, rows);
    tools(c, *region, rows, at, size.x);
    const ImVec2 min(at.x + t.px(8), at.y + t.px(34)), max(end.x - t.px(8), end.y - t.px(6));
    if (rows.empty()) {
        text_in(*ImGui::GetWindowDrawList(), t.regular, min, max, t.off,
                "Nothing is keyed yet. The diamond beside a slider keys its value");
        end_panel(c);
        return;
    }
    navigate_keys(c, {min.x + key_names_width(c), min.y}, max);
    if (s.view == 0)
        key_sheet(c, *region, rows, min, max);
    else
        key_curve_view(c, *region, rows, min, max);
    key_menu(c, *region);
    end_panel(c);
}

}  // namespace weft::ui
